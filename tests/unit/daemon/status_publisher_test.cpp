// SPDX-License-Identifier: MIT
#include "daemon/status_publisher.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/odometry/odometry_increment.hpp"
#include "test_client.hpp"
#include "tests/temporary_folder.hpp"

namespace cornerd::daemon {
namespace {

using drivers::LidarFault;
using drivers::LidarState;
using nlohmann::json;

class IdleLidar final : public drivers::LidarDriver {
 public:
  void run(std::stop_token /*stop*/, drivers::SampleSink& /*sink*/) override {}
  drivers::LidarStatus status() override { return {}; }
  bool take_change(drivers::LidarChange& /*change*/) override { return false; }
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

  static drivers::LidarChange change(LidarState state, LidarFault fault, std::string_view detail) {
    drivers::LidarChange change{.state = state, .fault = fault, .detail = {}};
    change.detail.set(detail);
    return change;
  }

  test::TemporaryFolder folder_;
  EventLoop loop_;
  MessageServer server_{loop_, "1", {[] {}}};
  Notifier notifier_;
  StatusPublisher publisher_{server_, notifier_};
  std::optional<TestClient> client_;
};

TEST_F(StatusPublisherTest, SameStateAndDetail_NoChange) {
  const auto absent = change(LidarState::kAbsent, LidarFault::kNoPort, "no port");
  EXPECT_TRUE(publisher_.update(absent, 0));
  EXPECT_EQ(next(), json::parse(R"({"class":"EVENT","t":0,"what":"device fault",
                                    "detail":"absent, no-port: no port"})"));
  EXPECT_FALSE(publisher_.update(absent, 0));
  EXPECT_TRUE(publisher_.update(change(LidarState::kAbsent, LidarFault::kNoPort, "still none"), 0));
  EXPECT_EQ(next(), "nothing") << "a new detail alone is no event";
}

TEST_F(StatusPublisherTest, EachStateAndFault_Event) {
  const auto expect = [this](const drivers::LidarChange& change, const char* what,
                             const char* detail) {
    publisher_.update(change, 1'000'000'000);
    const json event = next();
    EXPECT_EQ(event["what"], what);
    EXPECT_EQ(event["detail"], detail);
  };
  expect(change(LidarState::kStarting, LidarFault::kNone, ""), "device state", "starting");
  expect(change(LidarState::kRunning, LidarFault::kNone, ""), "device found", "running");
  expect(change(LidarState::kFaulty, LidarFault::kDeadLaser, "dark"), "device fault",
         "faulty, dead-laser: dark");
  expect(change(LidarState::kRunning, LidarFault::kNone, ""), "device found", "running");
  expect(change(LidarState::kBackoff, LidarFault::kUnplugged, "gone"), "device lost",
         "backoff, unplugged: gone");
}

class StatusFaults : public StatusPublisherTest {
 protected:
  static ScanPublisher::PublishedMaps hall() {
    core::FloorPlan plan;
    plan.name = "hall";
    plan.walls = {{{0, 0}, {1, 0}, 0.1}};
    return {{{std::make_shared<const core::WallMap>(std::move(plan))}}};
  }

  void localize(core::PoseState state, std::size_t scans) {
    ScanReport report;
    report.map = 0;
    report.result.pose.state = state;
    report.result.detection.segments.resize(4);
    for (std::size_t i = 0; i < scans; ++i) scans_.publish(report);
  }

  json published() {
    publisher_.publish(lidar_, scans_, localization_, {}, 0);
    json line = next();
    while (line.is_object() && line["class"] == "EVENT") line = next();
    return line;
  }

  IdleLidar idle_;
  Localization localization_{idle_,
                             std::make_unique<core::Pipeline>(nullptr, core::LocalizerConfig{}),
                             SourceKind::kDevice};
  ScanPublisher scans_{server_, hall()};
  drivers::LidarStatus lidar_;
};

TEST_F(StatusFaults, NothingIsWrong_NoFaultsAndNoHint) {
  localize(core::PoseState::kFix, 100);
  const json status = published();
  EXPECT_EQ(status["class"], "STATUS");
  EXPECT_FALSE(status.contains("faults"));
  EXPECT_FALSE(status.contains("hint"));
}

TEST_F(StatusFaults, ScansFitNowhere_MapMismatchUntilTheyFit) {
  localize(core::PoseState::kLost, 94);
  EXPECT_FALSE(published().contains("faults"));
  localize(core::PoseState::kLost, 1);
  const json status = published();
  EXPECT_EQ(status["faults"], json::parse(R"(["map-mismatch"])"));
  EXPECT_EQ(status["hint"].get<std::string>().find(
                "95 of the last 100 scans fit nowhere in the map \"hall\""),
            0U);
  localize(core::PoseState::kTracking, 6);
  EXPECT_FALSE(published().contains("faults"));
}

TEST_F(StatusFaults, ManySkippedBytes_DamagedLineUntilTheyAreFew) {
  const auto send = [&](std::uint64_t skipped_of_4000) {
    lidar_.counters.bytes += 4000;
    lidar_.counters.skipped_bytes += skipped_of_4000;
    return published();
  };
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(send(300).contains("faults"));
  json status;
  for (int i = 0; i < 20; ++i) status = send(880);
  EXPECT_EQ(status["faults"], json::parse(R"(["damaged-line"])"));
  for (int i = 0; i < 20; ++i) status = send(0);
  EXPECT_FALSE(status.contains("faults"));
}

TEST_F(StatusFaults, LidarFaultAndUnhealthyOdometry_InTheOrderOfWeight) {
  lidar_.state = LidarState::kFaulty;
  lidar_.fault = LidarFault::kDeadLaser;
  lidar_.detail.set("dark");
  ScanReport report;
  report.result.odometry.present = true;
  report.result.odometry.healthy = false;
  for (int i = 0; i < 50; ++i) scans_.publish(report);
  const json status = published();
  EXPECT_EQ(status["faults"], json::parse(R"(["dead-laser", "odometry-unhealthy"])"));
  EXPECT_EQ(status["hint"], "dark");
}

TEST_F(StatusFaults, LearnedWallsThatCannotBeStored_AreTheLastFault) {
  publisher_.set_file_problems("cannot store it", "");
  const json status = published();
  EXPECT_EQ(status["faults"], json::parse(R"(["walls-file"])"));
  EXPECT_EQ(status["hint"], "cannot store it");
  publisher_.set_file_problems("", "nor this");
  EXPECT_EQ(published()["faults"], json::parse(R"(["calibration-file"])"));
  publisher_.set_file_problems("", "");
  EXPECT_FALSE(published().contains("faults"));
}

TEST_F(StatusFaults, FaultOfLidar_StaysNamedWhileItIsTriedAgain) {
  lidar_.state = LidarState::kBackoff;
  lidar_.fault = LidarFault::kNoAnswer;
  lidar_.detail.set("no answer");
  EXPECT_EQ(published()["hint"], "no answer");
  lidar_.state = LidarState::kIdentifying;
  lidar_.fault = LidarFault::kNone;
  lidar_.detail.set("asking");
  const json again = published();
  EXPECT_EQ(again["faults"], json::parse(R"(["no-answer"])"));
  EXPECT_EQ(again["hint"], "no answer");
  EXPECT_EQ(again["lidar"]["state"], "identifying");
  EXPECT_FALSE(again["lidar"].contains("fault"));
  lidar_.state = LidarState::kRunning;
  EXPECT_FALSE(published().contains("faults"));
  lidar_.state = LidarState::kIdentifying;
  EXPECT_FALSE(published().contains("faults"));
}

TEST_F(StatusFaults, ReloadOfTheSameRobot_KeepsTheFaultsOfItsWheels) {
  settings::Config config;
  config.odometry.source = settings::OdometrySource::kSocket;
  config.odometry.core.enabled = true;
  publisher_.configure(config);
  ScanReport report;
  report.result.pose.state = core::PoseState::kFix;
  double left_m = 0;
  double right_m = 0;
  for (int step = 0; step < 1000; ++step) {
    const double rotation_rad = 0.02 * std::sin(step * 0.02);
    report.result.pose.T_map_base = report.result.pose.T_map_base * core::arc(0.008, rotation_rad);
    const double half_m = rotation_rad * config.odometry.core.geometry.track_m / 2;
    left_m += 0.008 - half_m;
    right_m += 0.008 + half_m;
    core::OdometryReading swapped;
    swapped.t_ns = report.result.pose.t_ns = step * core::TimeNs{20'000'000};
    swapped.left = std::llround(right_m / config.odometry.core.geometry.metres_per_count());
    swapped.right = std::llround(left_m / config.odometry.core.geometry.metres_per_count());
    publisher_.observe(swapped);
    publisher_.observe(report);
  }
  EXPECT_EQ(published()["faults"], json::parse(R"(["wheels-swapped"])"));
  publisher_.configure(config);
  EXPECT_EQ(published()["faults"], json::parse(R"(["wheels-swapped"])"));
  config.odometry.core.geometry.track_m = 0.3;
  publisher_.configure(config);
  EXPECT_FALSE(published().contains("faults"));
}

TEST_F(StatusFaults, RecordingThatCannotBeReplayed_IsNamed) {
  lidar_.state = LidarState::kFaulty;
  lidar_.detail.set("a.bin: no sample in it");
  const json status = published();
  EXPECT_EQ(status["faults"], json::parse(R"(["recording"])"));
  EXPECT_EQ(status["hint"], "a.bin: no sample in it");
}

TEST_F(StatusPublisherTest, Status_Published_HasCountersOfDriverAndDaemon) {
  IdleLidar idle;
  Localization localization(idle,
                            std::make_unique<core::Pipeline>(nullptr, core::LocalizerConfig{}),
                            SourceKind::kDevice);
  ScanPublisher scans(server_, {});
  ScanReport report;
  report.latency_ns = 2'000'000;
  scans.publish(report);
  EXPECT_EQ(next()["what"], "state change");

  drivers::LidarStatus status;
  status.state = LidarState::kFaulty;
  status.fault = LidarFault::kMotorStalled;
  status.detail.set("fine");
  status.counters.bad_checksums = 7;
  status.latency.add(300'000);
  DaemonHealth health{.priority = 20, .memory_is_locked = true, .server = {}};
  health.server.add(2'000'000'000);
  publisher_.publish(status, scans, localization, health, 5'000'000'000);
  const json line = next();
  EXPECT_EQ(line["t"], 5);
  EXPECT_EQ(line["lidar"]["state"], "faulty");
  EXPECT_EQ(line["lidar"]["fault"], "motor-stalled");
  EXPECT_EQ(line["lidar"]["detail"], "fine");
  EXPECT_EQ(line["counters"]["bad_checksums"], 7);
  EXPECT_EQ(line["counters"]["poses_lost"], 1);
  EXPECT_EQ(line["counters"]["poses_fix"], 0);
  EXPECT_EQ(line["counters"]["clients"], 1);
  EXPECT_EQ(line["latency"]["p99"], 0.002);
  const json& realtime = line["realtime"];
  EXPECT_EQ(realtime["priority"], 20);
  EXPECT_EQ(realtime["memory_locked"], true);
  EXPECT_EQ(realtime["edges"][2], 0.0005);
  EXPECT_EQ(realtime["reader"]["counts"][2], 1);
  EXPECT_EQ(realtime["reader"]["max"], 0.0003);
  EXPECT_EQ(realtime["server"]["counts"].back(), 1) << "beyond the last edge";
  EXPECT_EQ(realtime["server"]["counts"].size(), realtime["edges"].size() + 1);
  EXPECT_TRUE(realtime["localizer"].contains("page_faults"));
}

}  // namespace
}  // namespace cornerd::daemon
