// SPDX-License-Identifier: MIT
#include "mqtt/fleet_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "fake_broker.hpp"
#include "settings/sha256.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::mqtt {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class FleetMapTest : public ::testing::Test {
 protected:
  FleetMapTest() {
    config_.map = "hall";
    config_.map_folder = folder_ / "";
    robot_.is_daemon_connected = true;
  }
  FleetMap make() {
    return {config_, broker_, robot_, [this](std::string line, auto done) {
              if (is_busy_) return false;
              asked_.push_back(std::move(line));
              done_ = std::move(done);
              return true;
            }};
  }
  static std::string map_of(double width_m) {
    return R"({"format":"cornerd-map","version":1,"walls":[{"from":[0,0],"to":[)" +
           std::to_string(width_m) + ",0]}]}";
  }
  static MapAnnouncement announcement_of(std::uint64_t version, const std::string& text) {
    return {"hall", version, settings::sha256(text), text.size()};
  }
  void announce(FleetMap& map, const MapAnnouncement& announcement) {
    map.on_broker({"cornerd/default/map/hall", map_announcement_json(announcement), true});
  }
  void publish(FleetMap& map, std::uint64_t version, const std::string& text) {
    const MapAnnouncement announcement = announcement_of(version, text);
    announce(map, announcement);
    map.on_broker({map_file_topic("default", announcement), text, true});
  }
  void answer(client::Answer::Kind kind, const std::string& text = {}) {
    const auto done = std::move(done_);
    done({kind, text});
  }
  /// The daemon runs the map that it was told of last.
  void runs(FleetMap& map, const std::string& text) {
    robot_.map_hash = settings::sha256(text);
    map.on_daemon_map();
  }

  test::TemporaryFolder folder_;
  BridgeConfig config_;
  FakeBroker broker_;
  RobotState robot_;
  bool is_busy_ = false;
  std::vector<std::string> asked_;
  std::function<void(const client::Answer&)> done_;
};

TEST_F(FleetMapTest, NewerMap_IsFetchedCheckedKeptAndUsed) {
  FleetMap map = make();
  EXPECT_THAT(broker_.filters, Contains("cornerd/default/map/hall"));
  const MapAnnouncement first = announcement_of(1, map_of(3));
  announce(map, first);
  EXPECT_THAT(broker_.filters, Contains(map_file_topic("default", first)));
  map.on_broker({map_file_topic("default", first), map_of(3), true});
  EXPECT_THAT(broker_.filters, Not(Contains(map_file_topic("default", first))));
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_THAT(asked_[0], HasSubstr("hall.1.json"));
  answer(client::Answer::Kind::kOk);
  runs(map, map_of(3));
  ASSERT_EQ(robot_.maps.size(), 1u);
  EXPECT_TRUE(robot_.maps[0].is_in_use);
  EXPECT_EQ(robot_.map_problem, "");

  publish(map, 2, map_of(4));
  publish(map, 5, map_of(5));
  EXPECT_EQ(asked_.size(), 3u);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "hall.1.json")) << "two are kept";
  EXPECT_TRUE(std::filesystem::exists(folder_ / "hall.2.json"));
}

TEST_F(FleetMapTest, CorruptMap_ChangesNothingAndIsTold) {
  FleetMap map = make();
  publish(map, 1, map_of(3));
  answer(client::Answer::Kind::kOk);
  runs(map, map_of(3));
  const MapAnnouncement wrong = announcement_of(2, map_of(4));
  announce(map, wrong);
  map.on_broker({map_file_topic("default", wrong), map_of(5), true});
  EXPECT_THAT(robot_.map_problem, HasSubstr("version 2"));
  publish(map, 3, "no map");
  EXPECT_THAT(robot_.map_problem, HasSubstr("version 3"));
  for (const char* garbage : {"{", "[]", "\xff", R"({"map":"other","version":9})"}) {
    map.on_broker({"cornerd/default/map/hall", garbage, true});
    EXPECT_THAT(robot_.map_problem, HasSubstr("is no announcement"));
  }
  EXPECT_EQ(asked_.size(), 1u);
  EXPECT_EQ(robot_.maps.size(), 1u);
  EXPECT_TRUE(robot_.maps[0].is_in_use);
}

TEST_F(FleetMapTest, MapThatTheDaemonRefuses_IsDropped) {
  FleetMap map = make();
  publish(map, 1, map_of(3));
  answer(client::Answer::Kind::kError,
         R"({"class":"ERROR","code":"map","message":"must be below /etc"})");
  EXPECT_THAT(robot_.map_problem, HasSubstr("must be below /etc"));
  EXPECT_TRUE(robot_.maps.empty());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "hall.1.json"));
}

TEST_F(FleetMapTest, OlderOrOtherMapOfOneVersion_IsNotFetched) {
  FleetMap map = make();
  publish(map, 5, map_of(3));
  announce(map, announcement_of(4, map_of(4)));
  EXPECT_EQ(robot_.map_problem, "");
  announce(map, announcement_of(5, map_of(4)));
  EXPECT_THAT(robot_.map_problem, HasSubstr("another SHA-256"));
  announce(map, announcement_of(5, map_of(3)));
  EXPECT_EQ(robot_.map_problem, "");
  EXPECT_EQ(broker_.filters.size(), 1u);
}

TEST_F(FleetMapTest, RestartedDaemon_GetsTheKeptMapOnce) {
  {
    FleetMap map = make();
    publish(map, 1, map_of(3));
  }
  std::ofstream(folder_ / "hall.9.json") << "damaged";
  FleetMap map = make();
  ASSERT_EQ(robot_.maps.size(), 1u) << "kept by the run before";
  asked_.clear();
  map.on_daemon_connected();
  runs(map, map_of(7));
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_THAT(asked_[0], HasSubstr("hall.1.json"));
  answer(client::Answer::Kind::kOk);
  runs(map, map_of(3));
  runs(map, map_of(7));
  EXPECT_EQ(asked_.size(), 1u) << "somebody's own SET_MAP stands";
}

TEST_F(FleetMapTest, AbsentDaemon_SwitchesWhenItIsBack) {
  FleetMap map = make();
  publish(map, 1, map_of(3));
  answer(client::Answer::Kind::kNone, "it is away");
  EXPECT_THAT(robot_.map_problem, HasSubstr("it is away"));
  map.on_daemon_connected();
  runs(map, map_of(7));
  ASSERT_EQ(asked_.size(), 2u);
  answer(client::Answer::Kind::kOk);
  EXPECT_EQ(robot_.map_problem, "");
}

TEST_F(FleetMapTest, BusyDaemon_IsAskedAgainAndTheMapIsKept) {
  FleetMap map = make();
  is_busy_ = true;  // requests of a flood wait
  publish(map, 1, map_of(3));
  EXPECT_THAT(robot_.map_problem, HasSubstr("busy"));
  map.retry();
  EXPECT_TRUE(asked_.empty());
  is_busy_ = false;
  map.retry();
  ASSERT_EQ(asked_.size(), 1u);
  answer(client::Answer::Kind::kError, R"({"class":"ERROR","code":"busy","message":"wait"})");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "hall.1.json"));
  map.retry();
  ASSERT_EQ(asked_.size(), 2u);
  answer(client::Answer::Kind::kNone, "no answer");
  map.retry();
  ASSERT_EQ(asked_.size(), 3u);
  answer(client::Answer::Kind::kOk);
  EXPECT_EQ(robot_.map_problem, "");
  map.retry();
  EXPECT_EQ(asked_.size(), 3u);
}

TEST_F(FleetMapTest, AnnouncedMapWithoutItsBytes_IsTold) {
  FleetMap map = make();
  const MapAnnouncement announcement = announcement_of(1, map_of(3));
  announce(map, announcement);
  map.retry();
  EXPECT_EQ(robot_.map_problem, "") << "asked for a moment ago";
  map.retry();
  EXPECT_THAT(robot_.map_problem, HasSubstr("have not come"));
  map.on_broker({map_file_topic("default", announcement), map_of(3), true});
  EXPECT_EQ(robot_.map_problem, "");
}

TEST_F(FleetMapTest, FolderThatCannotBeWritten_IsTold) {
  config_.map_folder = folder_ / "absent";
  FleetMap map = make();
  publish(map, 1, map_of(3));
  EXPECT_THAT(robot_.map_problem, HasSubstr("cannot be kept"));
  EXPECT_TRUE(asked_.empty());
}

}  // namespace
}  // namespace cornerd::mqtt
