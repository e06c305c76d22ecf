// SPDX-License-Identifier: MIT
#include "drivers/config/lidar_models.hpp"
#include "rplidar_driver_fixture.hpp"

namespace cornerd::rplidar::test {
namespace {

using drivers::LidarFault;
using drivers::LidarState;
using std::chrono::seconds;
using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::Not;

TEST_F(RplidarDriverTest, HealthyDevice_RunsInExpressAndIsStopped) {
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

TEST_F(RplidarDriverTest, ClockOffset_DoesNotChangeSampleTimes) {
  clock.offset_ns = 1'700'000'000 * core::kNsPerSecond;
  const core::TimeNs start_ns = clock.now_ns;
  run(seconds(2));
  ASSERT_FALSE(samples.all.empty());
  EXPECT_GT(samples.all.front().t_ns, start_ns);
  EXPECT_LT(samples.all.back().t_ns, start_ns + 2 * core::kNsPerSecond);
}

TEST_F(RplidarDriverTest, DamagedPeriodAnswer_MakesNoWrongTimes) {
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

TEST_F(RplidarDriverTest, UncountedModes_TypicalOneIsUsed) {
  a1.counts_modes = false;
  run(seconds(3));
  EXPECT_EQ(last.state, LidarState::kRunning);
  EXPECT_EQ(last.mode.view(), "Express");
  EXPECT_THAT(names(a1.requests), Contains("EXPRESS 1"));
}

TEST_F(RplidarDriverTest, C1OfFirmware102_HasItsModesAsked) {
  a1.info = {.model = 0x41, .firmware = firmware_version(1, 2), .hardware = 18};
  run(seconds(1));
  EXPECT_EQ(last.model.view(), "C1M1");
  ASSERT_NE(last.known_model, nullptr);
  EXPECT_EQ(last.known_model->name, "c1");
  EXPECT_THAT(names(a1.requests), Contains("CONF"));
}

TEST_F(RplidarDriverTest, UnknownMode_FaultListsTheModes) {
  a1.mode_names = {"Standard", "Express", "Boost"};
  make("Sensitivity");
  run(seconds(1));
  EXPECT_EQ(last.state, LidarState::kFaulty);
  EXPECT_EQ(last.fault, LidarFault::kNoSuchMode);
  EXPECT_EQ(last.detail.view(),
            "/dev/lidar: no scan mode \"Sensitivity\"; set advanced.lidar.mode to one of Standard, "
            "Express, "
            "Boost");
}

TEST_F(RplidarDriverTest, Firmware117_UsesLegacyExpress) {
  a1.info.firmware = firmware_version(1, 17);
  run(seconds(1));
  EXPECT_THAT(names(a1.requests), IsSupersetOf({"RATE", "EXPRESS 0"}));
  EXPECT_THAT(names(a1.requests), Not(Contains("CONF")));
}

TEST_F(RplidarDriverTest, Firmware115_UsesScan) {
  a1.info.firmware = firmware_version(1, 15);
  run(seconds(1));
  EXPECT_THAT(names(a1.requests), testing::Each(testing::AnyOf("STOP", "INFO", "HEALTH", "SCAN")));
  EXPECT_EQ(last.mode.view(), "Standard");
}

TEST_F(RplidarDriverTest, EveryByte_IsUsedOrSkipped) {
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

TEST_F(RplidarDriverTest, Stop_EndsRunWithin200Ms) {
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

}  // namespace
}  // namespace cornerd::rplidar::test
