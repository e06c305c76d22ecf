// SPDX-License-Identifier: MIT
#include "daemon/status_publisher.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scratch_folder.hpp"
#include "test_client.hpp"

namespace cornerd::daemon {
namespace {

using drivers::LidarState;
using nlohmann::json;

class IdleLidar final : public drivers::LidarDriver {
 public:
  void run(std::stop_token /*stop*/, drivers::SampleSink& /*sink*/) override {}
  drivers::LidarStatus status() override { return {}; }
};

class StatusPublisherTest : public ::testing::Test {
 protected:
  StatusPublisherTest() {
    server_.listen(folder_ / "s", SocketRole::kPose);
    client_.emplace(folder_ / "s");
    loop_.run_once(1000);
    EXPECT_EQ(next()["class"], "VERSION");
    client_->send(R"({"class":"WATCH","classes":["EVENT","STATUS"]})"
                  "\n");
    loop_.run_once(1000);
    EXPECT_EQ(next()["class"], "OK");
  }

  json next() {
    const auto line = client_->read_line(0);
    return line ? json::parse(*line) : json("nothing");
  }

  static drivers::LidarStatus lidar(LidarState state, std::string_view detail) {
    drivers::LidarStatus status;
    status.state = state;
    status.detail.set(detail);
    return status;
  }

  ScratchFolder folder_;
  EventLoop loop_;
  MessageServer server_{loop_, "1", {[] {}}};
  Notifier notifier_;
  StatusPublisher publisher_{server_, notifier_};
  std::optional<TestClient> client_;
};

TEST_F(StatusPublisherTest, SameStateAndReason_IsNoChange) {
  EXPECT_TRUE(publisher_.notice_change(lidar(LidarState::kAbsent, "no port"), 0));
  EXPECT_FALSE(publisher_.notice_change(lidar(LidarState::kAbsent, "no port"), 0));
  EXPECT_TRUE(publisher_.notice_change(lidar(LidarState::kAbsent, "still no port"), 0));
  EXPECT_EQ(next(), "nothing") << "an event is for found and lost alone";
}

TEST_F(StatusPublisherTest, DeviceFoundAndLost_AreEvents) {
  publisher_.notice_change(lidar(LidarState::kAbsent, "no port"), 0);
  publisher_.notice_change(lidar(LidarState::kRunning, ""), 1'000'000'000);
  EXPECT_EQ(next(), json::parse(R"({"class":"EVENT","t":1,"what":"device found",
                                    "detail":"running"})"));
  publisher_.notice_change(lidar(LidarState::kBackoff, "silence"), 2'000'000'000);
  EXPECT_EQ(next(), json::parse(R"({"class":"EVENT","t":2,"what":"device lost",
                                    "detail":"backoff: silence"})"));
}

TEST_F(StatusPublisherTest, Status_HasTheDriversCountersAndTheDaemonsOwn) {
  IdleLidar idle;
  const Localization localization(idle, {nullptr, core::LocalizerConfig{}},
                                  SampleChannel::WhenFull::kLose);
  TurnPublisher turns(server_, nullptr);
  TurnReport report;
  report.latency_ns = 2'000'000;
  turns.publish(report);
  EXPECT_EQ(next()["what"], "state change");

  drivers::LidarStatus status = lidar(LidarState::kRunning, "fine");
  status.counters.bad_checksums = 7;
  publisher_.publish(status, turns, localization, 5'000'000'000);
  const json line = next();
  EXPECT_EQ(line["t"], 5);
  EXPECT_EQ(line["lidar"]["state"], "running");
  EXPECT_EQ(line["lidar"]["detail"], "fine");
  EXPECT_EQ(line["counters"]["bad_checksums"], 7);
  EXPECT_EQ(line["counters"]["poses_lost"], 1);
  EXPECT_EQ(line["counters"]["poses_fix"], 0);
  EXPECT_EQ(line["counters"]["clients"], 1);
  EXPECT_EQ(line["latency"]["p99"], 0.002);
}

}  // namespace
}  // namespace cornerd::daemon
