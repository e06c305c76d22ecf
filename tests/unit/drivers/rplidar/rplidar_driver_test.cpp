// SPDX-License-Identifier: MIT
#include "drivers/rplidar/rplidar_driver.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "scripted_a1.hpp"

namespace cornerd::rplidar::test {
namespace {

using drivers::LidarState;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class Samples : public drivers::SampleSink {
 public:
  void on_sample(const core::Sample& sample) override { all.push_back(sample); }
  void on_gap() override { ++gaps; }
  std::vector<core::Sample> all;
  int gaps = 0;
};

class RplidarDriverTest : public testing::Test {
 public:
  /// Runs the driver until `duration` has passed on the clock.
  void run(std::chrono::milliseconds duration) {
    std::stop_source stop;
    const core::TimeNs end_ns = clock.now_ns + std::chrono::nanoseconds(duration).count();
    clock.on_advance = [&, end_ns] {
      const auto status = driver->status();
      if (states.empty() || states.back() != status.state) states.push_back(status.state);
      last = status;
      if (clock.now_ns >= end_ns) stop.request_stop();
    };
    driver->run(stop.get_token(), samples);
    clock.on_advance = nullptr;
  }

  void make(const std::string& mode = "auto") {
    driver.emplace(
        RplidarDriverConfig{.device = "/dev/lidar", .mode = mode, .motor = {}},
        [this] { return a1.open(); }, clock);
  }

  void SetUp() override { make(); }

  ManualClock clock;
  ScriptedA1 a1{clock};
  Samples samples;
  std::optional<RplidarDriver> driver;
  std::vector<LidarState> states;
  drivers::LidarStatus last;
};

TEST_F(RplidarDriverTest, HealthyDevice_RunsInExpressAndIsLeftQuiet) {
  run(seconds(3));
  EXPECT_THAT(states,
              ElementsAre(LidarState::kIdentifying, LidarState::kStarting, LidarState::kRunning));
  EXPECT_EQ(last.model.view(), "A1M8");
  EXPECT_EQ(last.firmware.view(), "1.29");
  EXPECT_EQ(last.health.view(), "good");
  EXPECT_EQ(last.mode.view(), "Express");
  EXPECT_NEAR(last.rate_hz, 21.4 / 360 / (32 * 254e-6), 0.1);
  EXPECT_NEAR(last.samples_hz, 1 / 254e-6, 10);
  EXPECT_GT(last.counters.turns, 15U);
  EXPECT_GT(samples.all.size(), 8000U);

  const auto sent = names(a1.requests);
  EXPECT_EQ(sent[0], "STOP");
  EXPECT_EQ(sent[1], "INFO");
  EXPECT_EQ(sent[2], "HEALTH");
  EXPECT_EQ(sent[sent.size() - 2], "EXPRESS 1");
  EXPECT_EQ(sent.back(), "STOP");
  EXPECT_FALSE(a1.motor_turns);
}

TEST_F(RplidarDriverTest, Samples_BearUnixTime) {
  clock.offset_ns = 1'700'000'000 * core::kNsPerSecond;
  const core::TimeNs start_ns = clock.now_ns + clock.offset_ns;
  run(seconds(2));
  ASSERT_FALSE(samples.all.empty());
  EXPECT_GT(samples.all.front().t_ns, start_ns);
  EXPECT_LT(samples.all.back().t_ns, start_ns + 2 * core::kNsPerSecond);
}

TEST_F(RplidarDriverTest, ModeByName_IsUsed) {
  make("sensitivity");
  run(seconds(1));
  EXPECT_THAT(names(a1.requests), Contains("EXPRESS 3"));
  EXPECT_EQ(last.mode.view(), "Sensitivity");
}

TEST_F(RplidarDriverTest, ModeThatTheDeviceLacks_IsNamedWithThoseItHas) {
  a1.mode_names = {"Standard", "Express", "Boost"};
  make("Sensitivity");
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_EQ(last.detail.view(),
            "/dev/lidar: has no mode \"Sensitivity\", but Standard, Express, Boost");
}

TEST_F(RplidarDriverTest, Firmware117_UsesLegacyExpress) {
  a1.info.firmware = firmware_version(1, 17);
  run(seconds(1));
  EXPECT_THAT(names(a1.requests), IsSupersetOf({"RATE", "EXPRESS 0"}));
  EXPECT_THAT(names(a1.requests), Not(Contains("CONF")));
}

TEST_F(RplidarDriverTest, Firmware115_IsAskedForScanAlone) {
  a1.info.firmware = firmware_version(1, 15);
  run(seconds(1));
  EXPECT_THAT(names(a1.requests), testing::Each(testing::AnyOf("STOP", "INFO", "HEALTH", "SCAN")));
  EXPECT_EQ(last.mode.view(), "Standard");
}

TEST_F(RplidarDriverTest, DeviceThatWasLeftScanning_IsQuietedFirst) {
  a1.chatter = join(express_capsules(3, 100));
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_EQ(a1.opened, 1);
}

TEST_F(RplidarDriverTest, LostAnswer_IsAskedForAgain) {
  a1.lost_answers = 2;
  run(seconds(3));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_EQ(a1.opened, 1);
}

TEST_F(RplidarDriverTest, BadHealth_IsResetOnce) {
  a1.health = {Health{.status = 2, .code = 0x8001}, Health{}};
  run(seconds(3));
  EXPECT_EQ(a1.resets, 1);
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(states, Contains(LidarState::kFaulty));
}

TEST_F(RplidarDriverTest, HealthThatStaysBad_IsAFaultWithItsCode) {
  a1.health = {Health{.status = 2, .code = 0x8001}};
  run(seconds(2));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_THAT(std::string(last.detail.view()), HasSubstr("0x8001"));
  EXPECT_THAT(names(a1.requests), Not(Contains("EXPRESS 1")));
}

TEST_F(RplidarDriverTest, MissingPort_IsWaitedFor) {
  a1.unplugged_at_ns = 0;
  run(seconds(5));
  EXPECT_THAT(states, ElementsAre(LidarState::kAbsent));
  EXPECT_EQ(last.detail.view(), "/dev/lidar: no such port; waiting for it");
  EXPECT_THAT(a1.opened, testing::AllOf(testing::Ge(5), testing::Le(8))) << "0.1 s, doubled to 2 s";
  a1.unplugged_at_ns.reset();
  run(seconds(2));
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, PortOfAnotherProcess_IsWaitedForByName) {
  a1.open_error = drivers::OpenError::kBusy;
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kOpening);
  EXPECT_EQ(last.detail.view(), "/dev/lidar: held by another process; waiting for it");
}

TEST_F(RplidarDriverTest, SilentDevice_IsReportedAndTriedAgain) {
  a1.answers = false;
  run(seconds(5));
  EXPECT_EQ(last.state, LidarState::kIdentifying);
  EXPECT_THAT(states, Contains(LidarState::kBackoff));
  EXPECT_EQ(a1.opened, 2);
}

TEST_F(RplidarDriverTest, UnpluggedAndBack_RunsAgain) {
  a1.unplugged_at_ns = clock.now_ns + 2 * core::kNsPerSecond;
  run(seconds(3));
  EXPECT_THAT(states, Contains(LidarState::kAbsent));
  EXPECT_EQ(samples.gaps, 1);
  const auto before = samples.all.size();
  a1.unplugged_at_ns.reset();
  run(seconds(2));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_GT(samples.all.size(), before + 1000);
  EXPECT_GT(last.counters.samples, before + 1000) << "counters go on over a reopened port";
}

TEST_F(RplidarDriverTest, DeviceThatFallsSilent_IsReset) {
  std::stop_source stop;
  clock.on_advance = [&] {
    if (clock.now_ns > 3 * core::kNsPerSecond && a1.resets == 0) a1.measures = false;
    if (a1.resets > 0) a1.measures = true;
    if (clock.now_ns > 10 * core::kNsPerSecond) stop.request_stop();
    last = driver->status();
  };
  driver->run(stop.get_token(), samples);
  EXPECT_EQ(a1.resets, 1);
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, StopWhileItWaits_EndsWithinAFifthOfASecond) {
  for (const bool answers : {true, false}) {
    a1.answers = answers;
    std::stop_source stop;
    core::TimeNs asked_ns = 0;
    const core::TimeNs ask_ns = clock.now_ns + 1'234'000'000;
    clock.on_advance = [&] {
      if (clock.now_ns < ask_ns || asked_ns != 0) return;
      asked_ns = clock.now_ns;
      stop.request_stop();
    };
    driver->run(stop.get_token(), samples);
    EXPECT_LE(clock.now_ns - asked_ns, core::kNsPerSecond / 5);
  }
}

TEST_F(RplidarDriverTest, MotorThatCannotBeStarted_IsAFault) {
  driver.emplace(
      RplidarDriverConfig{.device = "/dev/lidar",
                          .motor = {.kind = MotorKind::kGpio, .path = "/no/such/gpio"}},
      [this] { return a1.open(); }, clock);
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_THAT(std::string(last.detail.view()), HasSubstr("/no/such/gpio/value"));
}

}  // namespace
}  // namespace cornerd::rplidar::test
