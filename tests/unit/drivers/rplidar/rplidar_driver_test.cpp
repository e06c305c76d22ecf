// SPDX-License-Identifier: MIT
#include "drivers/rplidar/rplidar_driver.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "scripted_a1.hpp"

namespace cornerd::rplidar::test {
namespace {

using drivers::LidarFault;
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
      if (event && clock.now_ns >= event_ns) std::exchange(event, nullptr)();
      drivers::LidarChange change;
      while (driver->take_change(change)) {
        if (states.empty() || states.back() != change.state) states.push_back(change.state);
        if (change.fault != LidarFault::kNone) faults.push_back(change.fault);
        hints[change.fault] = change.detail.view();
      }
      last = driver->status();
      const auto& counters = last.counters;
      EXPECT_LE(counters.used_bytes + counters.skipped_bytes, counters.bytes);
      if (clock.now_ns >= end_ns) stop.request_stop();
    };
    driver->run(stop.get_token(), samples);
    clock.on_advance = nullptr;
  }

  /// What happens so long after now.
  void after(std::chrono::milliseconds duration, std::function<void()> happens) {
    event_ns = clock.now_ns + std::chrono::nanoseconds(duration).count();
    event = std::move(happens);
  }

  void make(const std::string& mode = "auto", std::uint32_t baud = 115200) {
    driver.emplace(
        RplidarDriverConfig{.device = "/dev/lidar", .baud = baud, .mode = mode, .motor = {}},
        [this](std::uint32_t at_baud) { return a1.open(at_baud); }, clock);
  }

  void SetUp() override { make(); }

  ManualClock clock;
  ScriptedA1 a1{clock};
  Samples samples;
  std::optional<RplidarDriver> driver;
  core::TimeNs event_ns = 0;
  std::function<void()> event;
  std::vector<LidarState> states;
  std::vector<LidarFault> faults;
  std::map<LidarFault, std::string> hints;
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
  EXPECT_GT(last.counters.scans, 15U);
  EXPECT_GT(samples.all.size(), 8000U);

  const auto sent = names(a1.requests);
  EXPECT_EQ(sent[0], "STOP");
  EXPECT_EQ(sent[1], "INFO");
  EXPECT_EQ(sent[2], "INFO");  // the answer has no checksum
  EXPECT_EQ(sent[3], "HEALTH");
  EXPECT_EQ(sent[sent.size() - 2], "EXPRESS 1");
  EXPECT_EQ(sent.back(), "STOP");
  EXPECT_FALSE(a1.motor_runs);
}

TEST_F(RplidarDriverTest, Samples_BearTheTimeThatNobodySets) {
  clock.offset_ns = 1'700'000'000 * core::kNsPerSecond;
  const core::TimeNs start_ns = clock.now_ns;
  run(seconds(2));
  ASSERT_FALSE(samples.all.empty());
  EXPECT_GT(samples.all.front().t_ns, start_ns);
  EXPECT_LT(samples.all.back().t_ns, start_ns + 2 * core::kNsPerSecond);
}

// A soak found it: noise in that answer, and 840 turns bore times of hours to come.
TEST_F(RplidarDriverTest, AnswerWithABitWrong_MakesNoWrongTimes) {
  for (const int minor : {29, 17}) {
    a1.info.firmware = firmware_version(1, minor);
    a1.wrong_periods = 1;
    samples.all.clear();
    make();
    run(seconds(1));
    ASSERT_GT(samples.all.size(), 100U);
    const double period_us =
        static_cast<double>(samples.all[32].t_ns - samples.all[0].t_ns) / 32 / 1000;
    EXPECT_NEAR(period_us, 252, 3) << minor;
  }
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
  EXPECT_EQ(last.fault, LidarFault::kNoSuchMode);
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
  EXPECT_THAT(faults, ElementsAre(LidarFault::kStreamRunning));
  EXPECT_EQ(a1.opened, 1);
}

TEST_F(RplidarDriverTest, DeviceThatWasLeftInAStandardScan_IsQuietedFirst) {
  a1.chatter = nodes(100, 10);
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, ElementsAre(LidarFault::kStreamRunning));
}

TEST_F(RplidarDriverTest, TalkThatIsNoMeasurement_IsNoStreamLeftRunning) {
  const std::string sentence = "$GPRMC,081836,A,3751.65,S,14507.36,E,000.0,360.0,130998*62\r\n";
  for (int i = 0; i < 5; ++i) {
    a1.chatter.insert(a1.chatter.end(), sentence.begin(), sentence.end());
  }
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, ElementsAre(LidarFault::kForeignTalk));
  EXPECT_THAT(hints[LidarFault::kForeignTalk], HasSubstr("no lidar's measurement"));
}

TEST_F(RplidarDriverTest, DeviceThatBoots_IsWaitedFor) {
  const std::string banner = "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm\r\nModel: 18\r\n";
  a1.chatter.assign(banner.begin(), banner.end());
  a1.lost_answers = 1;
  run(seconds(2));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, ElementsAre(LidarFault::kBooting));
  EXPECT_EQ(a1.opened, 1);
}

TEST_F(RplidarDriverTest, DeviceThatRestartsByItself_IsSaidAtOnceAndStartedAgain) {
  after(seconds(2), [&] {
    const std::string banner = "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm\r\nModel: 18\r\n";
    a1.output.insert(a1.output.end(), banner.begin(), banner.end());
    a1.scanning = false;
  });
  run(seconds(3));
  EXPECT_THAT(faults, Contains(LidarFault::kRestarted));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_EQ(a1.resets, 0);
}

TEST_F(RplidarDriverTest, WrongSpeed_IsFoundOutAndNamed) {
  a1.baud = 115200;
  make("auto", 57600);
  run(seconds(5));
  EXPECT_THAT(faults, Contains(LidarFault::kWrongBaud));
  EXPECT_EQ(hints[LidarFault::kWrongBaud],
            "/dev/lidar: no answer at the speed of the settings, but one at 115200 baud; set "
            "advanced.lidar.baud");
}

TEST_F(RplidarDriverTest, NoiseInsteadOfAnswers_IsAWrongSpeed) {
  a1.answers = false;
  a1.noise = true;
  run(seconds(5));
  EXPECT_THAT(faults, Contains(LidarFault::kWrongBaud));
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
  EXPECT_THAT(faults, ElementsAre(LidarFault::kProtectionStop));
}

TEST_F(RplidarDriverTest, HealthThatStaysBad_IsAFaultWithItsCode) {
  a1.health = {Health{.status = 2, .code = 0x8001}};
  run(seconds(2));
  EXPECT_THAT(faults, IsSupersetOf({LidarFault::kProtectionStop, LidarFault::kHealthError}));
  EXPECT_THAT(hints[LidarFault::kHealthError], HasSubstr("0x8001"));
  EXPECT_THAT(names(a1.requests), Not(Contains("EXPRESS 1")));
}

TEST_F(RplidarDriverTest, MissingPort_IsWaitedFor) {
  a1.unplugged_at_ns = 0;
  run(seconds(5));
  EXPECT_THAT(states, ElementsAre(LidarState::kAbsent));
  EXPECT_EQ(last.detail.view(), "/dev/lidar: no such port; waiting for it");
  EXPECT_EQ(last.fault, LidarFault::kNoPort);
  EXPECT_NEAR(a1.opened, 25, 1) << "five times a second, however long";
  a1.unplugged_at_ns.reset();
  run(seconds(2));
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, PortOfAnotherProcess_IsWaitedForByName) {
  a1.open_error = drivers::OpenError::kBusy;
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kOpening);
  EXPECT_EQ(last.fault, LidarFault::kPortHeld);
  EXPECT_EQ(last.detail.view(),
            "/dev/lidar: held by another process; waiting for it. `sudo cornerctl doctor` says by "
            "whom");
}

TEST_F(RplidarDriverTest, SilentDevice_IsReportedAndTriedAgain) {
  a1.answers = false;
  run(seconds(5));
  EXPECT_EQ(last.state, LidarState::kIdentifying);
  EXPECT_THAT(states, Contains(LidarState::kBackoff));
  EXPECT_THAT(faults, Contains(LidarFault::kNoAnswer));
  EXPECT_EQ(a1.opened, 2);
}

TEST_F(RplidarDriverTest, UnpluggedAndBack_RunsAgain) {
  a1.unplugged_at_ns = clock.now_ns + 2 * core::kNsPerSecond;
  run(seconds(3));
  EXPECT_THAT(states, Contains(LidarState::kAbsent));
  EXPECT_THAT(faults, IsSupersetOf({LidarFault::kUnplugged, LidarFault::kNoPort}));
  EXPECT_EQ(samples.gaps, 1);
  const auto before = samples.all.size();
  a1.unplugged_at_ns.reset();
  run(seconds(2));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_GT(samples.all.size(), before + 1000);
  EXPECT_GT(last.counters.samples, before + 1000) << "counters go on over a reopened port";
}

TEST_F(RplidarDriverTest, DeviceThatFallsSilent_IsSaidAndThenReset) {
  a1.resets_to_measure = 1;
  after(seconds(3), [&] { a1.measures = false; });
  run(milliseconds(4500));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_EQ(last.fault, LidarFault::kMotorStalled);
  EXPECT_EQ(a1.resets, 0);
}

TEST_F(RplidarDriverTest, HeadThatWasHeldUp_GoesOnWithoutAReset) {
  after(seconds(2), [&] {
    a1.measures = false;
    after(seconds(2), [&] { a1.measures = true; });
  });
  run(seconds(6));
  EXPECT_THAT(faults, ElementsAre(LidarFault::kMotorStalled));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_EQ(a1.resets, 0);
  EXPECT_EQ(a1.opened, 1);
}

TEST_F(RplidarDriverTest, ProtectionStopWhileItMeasures_IsSeenAfterASecondAndReset) {
  a1.resets_to_measure = 1;
  after(seconds(2), [&] {
    a1.measures = false;
    a1.health = {Health{.status = 2, .code = 0x8001}, Health{}};
  });
  run(milliseconds(3300));
  EXPECT_THAT(faults, IsSupersetOf({LidarFault::kMotorStalled, LidarFault::kProtectionStop}));
  run(seconds(2));
  EXPECT_EQ(a1.resets, 1);
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, SilenceThatLasts_EndsWithAReset) {
  a1.resets_to_measure = 1;
  after(seconds(2), [&] { a1.measures = false; });
  run(seconds(9));
  EXPECT_EQ(a1.resets, 1);
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, DeviceThatNeverMeasures_IsAFaultOfItsOwn) {
  a1.measures = false;
  run(seconds(8));
  EXPECT_THAT(faults, Contains(LidarFault::kNoData));
  EXPECT_THAT(faults, Not(Contains(LidarFault::kMotorStalled)));
}

TEST_F(RplidarDriverTest, LaserThatIsDead_IsAFaultUntilSomethingReturns) {
  a1.blind = true;
  after(seconds(6), [&] { a1.blind = false; });
  run(seconds(5));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_EQ(last.fault, LidarFault::kDeadLaser);
  run(seconds(3));
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, EachByteThatCame_IsUsedOrSkippedInTheEnd) {
  a1.chatter = join(express_capsules(3, 100));
  after(seconds(1), [&] {
    const Bytes garbage(37, 0x55);
    a1.output.insert(a1.output.end(), garbage.begin(), garbage.end());
  });
  run(seconds(3));
  const auto counters = driver->status().counters;
  EXPECT_EQ(counters.bytes, a1.read_bytes);
  EXPECT_EQ(counters.used_bytes + counters.skipped_bytes, counters.bytes);
  EXPECT_GE(counters.skipped_bytes, a1.chatter.size() + 37);
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
      [this](std::uint32_t at_baud) { return a1.open(at_baud); }, clock);
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_THAT(std::string(last.detail.view()), HasSubstr("/no/such/gpio/value"));
}

}  // namespace
}  // namespace cornerd::rplidar::test
