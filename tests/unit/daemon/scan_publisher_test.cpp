// SPDX-License-Identifier: MIT
#include "daemon/scan_publisher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "captured_log.hpp"
#include "test_client.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

using nlohmann::json;

class ScanPublisherTest : public ::testing::Test {
 protected:
  ScanPublisherTest() {
    server_.listen(folder_ / "s", SocketRole::kPose);
    client_.emplace(folder_ / "s");
    loop_.run_once(1000);
    client_->send(R"({"class":"WATCH","classes":["EVENT"]})"
                  "\n");
    loop_.run_once(1000);
    while (client_->read_line(0)) {
    }
  }

  void publish_fix_at(double x_m) {
    report_.result.pose.state = core::PoseState::kFix;
    report_.result.pose.T_map_base = {x_m, 0, 0};
    ++report_.number;
    publisher_.publish(report_);
  }

  int events(const std::string& what) {
    int count = 0;
    while (const auto line = client_->read_line(0)) {
      if (json::parse(*line)["what"] == what) ++count;
    }
    return count;
  }

  test::TemporaryFolder folder_;
  EventLoop loop_;
  MessageServer server_{loop_, "1", {[] {}}};
  ScanPublisher publisher_{server_, {}};
  ScanReport report_;
  std::optional<TestClient> client_;
};

TEST_F(ScanPublisherTest, JumpAtEachScan_EventsAndOneLogLine) {
  publish_fix_at(0);
  const CapturedLog log;
  constexpr int kJumps = 5;
  for (int i = 1; i <= kJumps; ++i) publish_fix_at(i % 2 == 0 ? 0 : 1);
  EXPECT_EQ(events("jump"), kJumps);
  EXPECT_EQ(log.text(), "info: jump: 1.000 m, 0.0 degrees\n");
}

class NextMap : public ScanPublisherTest {
 protected:
  NextMap() {
    client_->send(R"({"class":"WATCH","classes":["MAP","POSE"]})"
                  "\n");
    loop_.run_once(1000);
    client_->read_line(1000);
  }

  static ScanPublisher::PublishedMaps map_named(const std::string& name) {
    core::FloorPlan plan;
    plan.name = name;
    plan.walls = {{{0, 0}, {1, 0}, 0.1}};
    auto line = std::make_shared<const std::string>(R"({"class":"MAP","name":")" + name + "\"}\n");
    return {{{std::make_shared<const core::WallMap>(std::move(plan)), line}}, {name}};
  }

  void publish_scan_of(std::uint32_t generation) {
    report_.generation = generation;
    if (generation > 0 && !report_.map) report_.map = 0;
    publish_fix_at(0);
  }

  /// What the client got: "MAP a", "POSE a".
  std::vector<std::string> received() {
    std::vector<std::string> lines;
    while (const auto line = client_->read_line(0)) {
      const json message = json::parse(*line);
      const char* key = message["class"] == "MAP" ? "name" : "map";
      lines.push_back(message["class"].get<std::string>() + " " + message.value(key, "-"));
    }
    return lines;
  }
};

TEST_F(NextMap, PublishedBeforeTheFirstPoseInIt) {
  publisher_.set_next_maps(1, map_named("a"));
  publish_scan_of(0);
  publish_scan_of(1);
  publish_scan_of(1);
  EXPECT_THAT(received(), testing::ElementsAre("POSE -", "MAP a", "POSE a", "POSE a"));
}

TEST_F(NextMap, TwoBeforeTheNextScan_TheNewestOnly) {
  publisher_.set_next_maps(1, map_named("a"));
  publisher_.set_next_maps(2, map_named("b"));
  publish_scan_of(2);
  EXPECT_THAT(received(), testing::ElementsAre("MAP b", "POSE b"));
}

TEST_F(NextMap, SecondWhileTheFirstIsInUse_EachBeforeItsPoses) {
  publisher_.set_next_maps(1, map_named("a"));
  publisher_.set_next_maps(2, map_named("b"));
  publish_scan_of(1);
  publish_scan_of(2);
  EXPECT_THAT(received(), testing::ElementsAre("MAP a", "POSE a", "MAP b", "POSE b"));
}

TEST_F(NextMap, OneOfSeveral_PublishedWhenItIsKnown) {
  ScanPublisher::PublishedMaps maps = map_named("a");
  maps.maps.push_back(map_named("b").maps.front());
  maps.names.emplace_back("b");
  publisher_.set_next_maps(1, maps);
  report_.generation = 1;
  EXPECT_FALSE(publisher_.choice());
  report_.map.reset();
  report_.result.pose.alternatives = {{{}, 0.7, 1}, {{}, 0.3, 0}};
  publish_fix_at(0);
  EXPECT_EQ(publisher_.map(), nullptr);
  EXPECT_EQ(publisher_.choice()->state, "ambiguous");
  EXPECT_THAT(publisher_.choice()->candidates, testing::ElementsAre("b", "a"));
  report_.result.pose.alternatives.clear();
  report_.map = 1;
  publish_fix_at(0);
  EXPECT_EQ(publisher_.choice()->state, "known");
  EXPECT_EQ(publisher_.choice()->name, "b");
  EXPECT_THAT(received(), testing::ElementsAre("POSE -", "MAP b", "POSE b"));
}

TEST_F(NextMap, WithoutScans_PublishedOnce) {
  publisher_.set_next_maps(1, map_named("a"));
  publisher_.publish_next_map();
  publisher_.publish_next_map();
  EXPECT_THAT(received(), testing::ElementsAre("MAP a"));
  publish_scan_of(1);
  EXPECT_THAT(received(), testing::ElementsAre("POSE a"));
}

}  // namespace
}  // namespace cornerd::daemon
