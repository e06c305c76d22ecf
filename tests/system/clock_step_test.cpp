// SPDX-License-Identifier: MIT
// Steps of the time of day, as on a board without a battery-backed clock once it has a network:
// poses of a live lidar continue and have the new time.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "daemon_process.hpp"
#include "emulated_lidar.hpp"
#include "heartbeat.hpp"
#include "service_manager.hpp"
#include "settable_clock.hpp"
#include "tests/sanitized.hpp"

namespace cornerd::system_test {
namespace {

constexpr double kHourBack_s = -3600;
constexpr double kYearAhead_s = 365.25 * 86400;
/// Maximum delay of a message on a busy machine; every step is longer.
constexpr double kLatest_s = 60;
constexpr int kPosesAfterStep = 15;

class ClockStep : public DaemonTest {
 protected:
  void SetUp() override {
    if (test::kSanitized) GTEST_SKIP() << "a sanitizer must be preloaded first";
  }

  DaemonProcess start_live(std::vector<std::string> more = {}) {
    more.insert(more.end(),
                {"/lidar/driver=rplidar", "/lidar/device=" + (folder_ / "lidar").string()});
    auto environment = clock_.environment();
    environment["NOTIFY_SOCKET"] = (folder_ / "notify").string();
    environment["WATCHDOG_USEC"] = "200000";
    return start(more, environment);
  }

  static void watch(TestClient& client) {
    client.send(R"({"class":"WATCH","classes":["POSE","EVENT","STATUS"]})"
                "\n");
  }

  /// True if the message has the current time of a clock with this offset.
  bool is_of_now(const json& message, double offset_s) const {
    const double late_s = clock_.now_s() - clock_.offset_s() - (message_s(message) - offset_s);
    return late_s > -1e-3 && late_s < kLatest_s;
  }
  static double message_s(const json& message) { return message["t"]; }

  /// Steps the clock and reads until the EVENT and later poses arrive. No pose may be missing, and
  /// each message must have the time of the old or of the new clock.
  void step(TestClient& client, double by_s) {
    const double before_s = clock_.offset_s();
    clock_.step_s(by_s);
    const double after_s = clock_.offset_s();
    int poses = 0;
    int poses_after = 0;
    std::vector<json> steps;
    while (poses_after < kPosesAfterStep || steps.empty()) {
      const json message = next(client);
      ASSERT_TRUE(message.is_object()) << "after a step of " << by_s << " s";
      const bool is_after = is_of_now(message, after_s);
      EXPECT_TRUE(is_after || is_of_now(message, before_s)) << message;
      if (message["class"] == "EVENT" && message["what"] == "clock step") steps.push_back(message);
      if (message["class"] != "POSE") continue;
      ASSERT_LT(++poses, 10 * kPosesAfterStep) << "the step was not detected";
      EXPECT_TRUE(is_after || poses_after == 0) << "back to the old time: " << message;
      poses_after += is_after ? 1 : 0;
      expect_next(message, message_s(message) - (is_after ? after_s : before_s));
    }
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_TRUE(is_of_now(steps[0], after_s)) << steps[0];
    EXPECT_NEAR(std::stod(steps[0]["detail"].get<std::string>()), by_s, 0.1) << steps[0];
  }

  /// `machine_s`: the pose's time by the machine's clock.
  void expect_next(const json& pose, double machine_s) {
    const std::uint64_t dropped = pose.value("dropped", 0u);
    EXPECT_TRUE(dropped == 0 || heartbeat_.stood_still_lately()) << pose;
    EXPECT_EQ(pose["state"], "fix") << pose;
    if (last_seq_ != 0) {
      EXPECT_EQ(pose["seq"].get<std::uint64_t>(), last_seq_ + 1 + dropped);
      EXPECT_GT(machine_s, last_s_) << pose;
    }
    last_seq_ = pose["seq"];
    last_s_ = machine_s;
  }

  SettableClock clock_{folder_ / "clock"};
  ServiceManager manager_{folder_ / "notify"};
  EmulatedLidar lidar_{folder_ / "map.json", folder_ / "lidar"};
  Heartbeat heartbeat_;

 private:
  std::uint64_t last_seq_ = 0;
  double last_s_ = 0;
};

TEST_F(ClockStep, StepsOfAnHourBackAndAYearAhead_NoPoseAndNoWatchdogMissing) {
  const DaemonProcess daemon = start_live();
  TestClient client = connect();
  watch(client);
  wait_for_fix(client);
  for (const double by_s : {kHourBack_s, kYearAhead_s}) {
    step(client, by_s);
    if (HasFatalFailure()) return;
    manager_.forget();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(manager_.hears("WATCHDOG=1"));
  }
  EXPECT_TRUE(daemon.is_running());
}

TEST_F(ClockStep, StepBackDuringBackoff_BackoffNotExtended) {
  lidar_.expect_speed(115200);
  const DaemonProcess daemon = start_live({"/advanced/lidar/baud=57600"});
  TestClient client = connect();
  watch(client);
  next_of(client, "STATUS",
          [](const json& status) { return status["lidar"]["state"] == "backoff"; });
  clock_.step_s(kHourBack_s);
  manager_.forget();
  EXPECT_TRUE(manager_.hears("WATCHDOG=1"));
  lidar_.expect_speed(57600);
  const json pose = next_of(client, "POSE");
  ASSERT_TRUE(pose.is_object()) << daemon.output();
  EXPECT_TRUE(is_of_now(pose, kHourBack_s)) << pose;
}

TEST_F(ClockStep, OdometryOfSameClock_AcceptedBeforeAndAfterStep) {
  const DaemonProcess daemon =
      start_live({"/odometry/source=socket", "/advanced/odometry/publish_predictions=true"});
  TestClient client = connect();
  watch(client);
  std::jthread controller([&, control = connect("control.sock")](std::stop_token stop) mutable {
    while (!stop.stop_requested()) {
      char line[96];
      std::snprintf(line, sizeof(line),
                    "{\"class\":\"ODOMETRY\",\"t\":%.6f,\"left\":7,\"right\":7,\"gyro\":0}\n",
                    clock_.now_s());
      control.send(line);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  wait_for_fix(client);
  for (const double by_s : {kHourBack_s, kYearAhead_s}) {
    clock_.step_s(by_s);
    for (int fixes = 0; fixes < kPosesAfterStep; ++fixes) wait_for_fix(client);
    json status = next_of(client, "STATUS");
    ASSERT_TRUE(status.is_object());
    const json& odometry = status["odometry"];
    EXPECT_EQ(odometry["state"], "running") << odometry;
    // Lines in transit have the old time.
    EXPECT_LT(odometry["counters"]["past"].get<int>(), 20) << odometry;
    EXPECT_LT(odometry["counters"]["future"].get<int>(), 20) << odometry;
    EXPECT_EQ(odometry["counters"]["restarts"], 0) << odometry;
    for (json pose = next_of(client, "POSE"); pose["state"] != "predicted";) {
      pose = next_of(client, "POSE");
      ASSERT_TRUE(pose.is_object());
      EXPECT_TRUE(is_of_now(pose, clock_.offset_s())) << pose;
    }
  }
}

}  // namespace
}  // namespace cornerd::system_test
