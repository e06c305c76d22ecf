// SPDX-License-Identifier: MIT
#include "rplidar_driver_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

using drivers::LidarFault;
using drivers::LidarState;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

TEST_F(RplidarDriverTest, DeviceLeftInExpressScan_IsStoppedFirst) {
  a1.chatter = join(express_capsules(3, 100));
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, ElementsAre(LidarFault::kStreamRunning));
  EXPECT_EQ(a1.opened, 1);
}

TEST_F(RplidarDriverTest, DeviceLeftInStandardScan_IsStoppedFirst) {
  a1.chatter = nodes(100, 10);
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, ElementsAre(LidarFault::kStreamRunning));
}

TEST_F(RplidarDriverTest, OtherBytesBeforeTheFirstRequest_AreUnexpectedData) {
  const std::string sentence = "$GPRMC,081836,A,3751.65,S,14507.36,E,000.0,360.0,130998*62\r\n";
  for (int i = 0; i < 5; ++i) {
    a1.chatter.insert(a1.chatter.end(), sentence.begin(), sentence.end());
  }
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, ElementsAre(LidarFault::kUnexpectedData));
  EXPECT_THAT(hints[LidarFault::kUnexpectedData],
              HasSubstr("no measurement of the configured lidar"));
}

TEST_F(RplidarDriverTest, BootingDevice_IsWaitedFor) {
  const std::string banner = "RP LIDAR System.\r\nFirmware Ver 1.29 - rtm\r\nModel: 18\r\n";
  a1.chatter.assign(banner.begin(), banner.end());
  a1.lost_answers = 1;
  run(seconds(2));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, ElementsAre(LidarFault::kBooting));
  EXPECT_EQ(a1.opened, 1);
}

TEST_F(RplidarDriverTest, RestartedDevice_IsReportedAndStartedAgain) {
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

TEST_F(RplidarDriverTest, WrongBaud_IsReportedWithTheDefaultBaud) {
  a1.baud = 115200;
  make("auto", {57600});
  run(seconds(5));
  EXPECT_THAT(faults, Contains(LidarFault::kWrongBaud));
  EXPECT_EQ(hints[LidarFault::kWrongBaud],
            "/dev/lidar: no answer at the configured speed, but one at 115200 baud; set "
            "advanced.lidar.baud");
}

TEST_F(RplidarDriverTest, NoiseInsteadOfAnswers_IsWrongBaud) {
  a1.answers = false;
  a1.noise = true;
  run(seconds(5));
  EXPECT_THAT(faults, Contains(LidarFault::kWrongBaud));
}

TEST_F(RplidarDriverTest, LostAnswer_IsRequestedAgain) {
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

TEST_F(RplidarDriverTest, BadHealthAfterReset_IsAFaultWithItsCode) {
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

TEST_F(RplidarDriverTest, BusyPort_IsWaitedFor) {
  a1.open_error = drivers::OpenError::kBusy;
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kOpening);
  EXPECT_EQ(last.fault, LidarFault::kPortBusy);
  EXPECT_EQ(last.detail.view(),
            "/dev/lidar: held by another process; waiting for it. `sudo cornerctl doctor` names "
            "the process");
}

TEST_F(RplidarDriverTest, SilentDevice_IsReportedAndRetried) {
  a1.answers = false;
  run(seconds(5));
  EXPECT_EQ(last.state, LidarState::kIdentifying);
  EXPECT_THAT(states, Contains(LidarState::kBackoff));
  EXPECT_THAT(faults, Contains(LidarFault::kNoAnswer));
  EXPECT_EQ(a1.opened, 5) << "at the configured speed, at the three others, and again";
}

TEST_F(RplidarDriverTest, WrongBaud_IsReportedWithTheFamilysOther) {
  a1.baud = 1'000'000;
  run(seconds(6));
  EXPECT_THAT(hints[LidarFault::kWrongBaud], HasSubstr("but one at 1000000 baud"));
}

TEST_F(RplidarDriverTest, SeveralRates_TheOneThatAnswersIsFoundWithoutAFault) {
  a1.baud = 460'800;
  make("auto", {115'200, 256'000, 460'800, 1'000'000});
  run(seconds(5));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_EQ(a1.opened, 3);
}

TEST_F(RplidarDriverTest, SeveralRates_NoneAnswers_AllAreNamed) {
  a1.answers = false;
  make("auto", {115'200, 256'000});
  run(seconds(5));
  EXPECT_THAT(hints[LidarFault::kNoAnswer], HasSubstr("an RPLidar at 115200, 256000 baud"));
}

TEST_F(RplidarDriverTest, SeveralRates_NoiseAtAll_IsUnexpectedData) {
  a1.answers = false;
  a1.noise = true;
  make("auto", {115'200, 256'000});
  run(seconds(5));
  EXPECT_THAT(faults, Contains(LidarFault::kUnexpectedData));
  EXPECT_THAT(faults, Not(Contains(LidarFault::kWrongBaud)));
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

TEST_F(RplidarDriverTest, SilenceOfOneSecond_IsReportedWithoutReset) {
  a1.resets_to_measure = 1;
  after(seconds(3), [&] { a1.measures = false; });
  run(milliseconds(4500));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_EQ(last.fault, LidarFault::kMotorStalled);
  EXPECT_EQ(a1.resets, 0);
}

TEST_F(RplidarDriverTest, HeadBlockedForTwoSeconds_ResumesWithoutReset) {
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

TEST_F(RplidarDriverTest, ProtectionStopWhileMeasuring_IsReportedAndReset) {
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

TEST_F(RplidarDriverTest, SilenceOfThreeSeconds_LeadsToAReset) {
  a1.resets_to_measure = 1;
  after(seconds(2), [&] { a1.measures = false; });
  run(seconds(9));
  EXPECT_EQ(a1.resets, 1);
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, DeviceWithoutData_HasFaultNoData) {
  a1.measures = false;
  run(seconds(8));
  EXPECT_THAT(faults, Contains(LidarFault::kNoData));
  EXPECT_THAT(faults, Not(Contains(LidarFault::kMotorStalled)));
}

TEST_F(RplidarDriverTest, NoReturns_IsAFaultUntilThereAreSome) {
  a1.blind = true;
  after(seconds(6), [&] { a1.blind = false; });
  run(seconds(5));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_EQ(last.fault, LidarFault::kDeadLaser);
  run(seconds(3));
  EXPECT_EQ(last.state, LidarState::kRunning);
}

TEST_F(RplidarDriverTest, MotorControlFailure_IsAFault) {
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
