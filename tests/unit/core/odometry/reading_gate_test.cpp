// SPDX-License-Identifier: MIT
#include "core/odometry/reading_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "gated_drive.hpp"

namespace cornerd::core {
namespace {

using testing::drive_with;
using testing::kLeft_m;
using testing::kMillisecond_ns;
using testing::Outcome;
using testing::small_robot;

TEST(ReadingGate, CleanDrive_IncrementsAreComplete) {
  const Outcome outcome = drive_with([](int, OdometryReading&) {});
  EXPECT_EQ(outcome.steps, 149);
  EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001);
  EXPECT_NEAR(outcome.gyro_rad, 0.1 * 0.02 * 149, 1e-9);
}

TEST(ReadingGate, ImpossibleSpeed_OnlyThatReadingIsRejected) {
  for (const std::int64_t garbage :
       {std::int64_t{30464}, std::int64_t{5198147}, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max()}) {
    const Outcome outcome = drive_with([&](int i, OdometryReading& reading) {
      if (i == 70) reading.left = garbage;
    });
    EXPECT_EQ(outcome.counters.jumps, 1U) << garbage;
    EXPECT_EQ(outcome.holes, 0);
    EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001);
  }
}

TEST(ReadingGate, PossibleSpike_OnlyThatReadingIsRejected) {
  for (const int counts : {200, 300, 420, -250}) {
    const Outcome outcome = drive_with([&](int i, OdometryReading& reading) {
      if (i == 70) reading.left = *reading.left + counts;
    });
    EXPECT_EQ(outcome.counters.jumps, 1U) << counts;
    EXPECT_EQ(outcome.steps, 148);
    EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001);
  }
}

TEST(ReadingGate, WheelSpinsUpSuddenly_IsFollowed) {
  const DriveGeometry geometry = small_robot().geometry;
  const auto spun = [&](int i) { return i < 70 ? 0 : (i - 69) * 2 * 0.02; };
  const Outcome outcome = drive_with([&](int i, OdometryReading& reading) {
    reading.left = *reading.left + std::llround(spun(i) / geometry.metres_per_count());
  });
  EXPECT_EQ(outcome.counters.jumps, 1U);
  EXPECT_EQ(outcome.steps, 148);
  EXPECT_EQ(outcome.holes, 0);
  EXPECT_NEAR(outcome.left_m, kLeft_m + spun(149), 0.001);
}

TEST(ReadingGate, CountsStayElsewhere_IsRestart) {
  const Outcome outcome = drive_with([](int i, OdometryReading& reading) {
    if (i >= 70) reading.left = *reading.left + 30464;
  });
  EXPECT_EQ(outcome.counters.restarts, 1U);
  EXPECT_EQ(outcome.holes, 1);
  EXPECT_NEAR(outcome.left_m, kLeft_m - 3 * 0.02 * 0.292, 0.002);
}

TEST(ReadingGate, ReadingsLost_CountsCoverThem) {
  const Outcome outcome = drive_with([](int i, OdometryReading& reading) {
    if (i > 70 && i < 80) reading.left.reset();
  });
  EXPECT_EQ(outcome.steps, 140);
  EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001);
  EXPECT_NEAR(outcome.gyro_rad, 0.1 * 0.02 * 149, 1e-9);
}

TEST(ReadingGate, OneSecondWithoutReadings_IsGap) {
  const Outcome outcome = drive_with([](int i, OdometryReading& reading) {
    if (i > 50 && i < 110) reading.right.reset();
  });
  EXPECT_EQ(outcome.holes, 1);
  EXPECT_EQ(outcome.counters.gaps, 1U);
}

TEST(ReadingGate, InvalidRates_AreDropped) {
  const Outcome outcome = drive_with([](int i, OdometryReading& reading) {
    if (i == 30) reading.gyro_rad_s = std::nan("");
    if (i == 50) reading.gyro_rad_s = 5198147;
  });
  EXPECT_EQ(outcome.counters.invalid_rates, 2U);
  EXPECT_NEAR(outcome.gyro_rad, 0.1 * 0.02 * 149, 0.01);
}

TEST(ReadingGate, GyroStuck_IsDetectedByWheels) {
  OdometryConfig config = small_robot();
  testing::DrivenRobot robot(config.geometry, {});
  ReadingGate gate(config);
  int with_gyro = 0;
  for (int i = 0; i < 100; ++i) {
    OdometryReading reading = robot.drive(0.02, 0.2, 1);
    reading.gyro_rad_s = 0.25;
    const auto step = gate.add(reading);
    with_gyro += step && step->has_gyro;
  }
  EXPECT_LT(with_gyro, 15);
  EXPECT_GT(gate.counters().stuck, 80U);
}

TEST(ReadingGate, GyroStuck_StaysRejectedWhenRotationReverses) {
  const OdometryConfig config = small_robot();
  testing::DrivenRobot robot(config.geometry, {});
  ReadingGate gate(config);
  int with_gyro = 0;
  for (int i = 0; i < 400; ++i) {
    OdometryReading reading = robot.drive(0.02, 0.2, i / 50 % 2 == 0 ? 1 : -1);
    reading.gyro_rad_s = 0;
    const auto step = gate.add(reading);
    with_gyro += step && step->has_gyro;
  }
  EXPECT_LT(with_gyro, 15);

  OdometryReading alive = robot.drive(0.02, 0.2, 1);
  alive.gyro_rad_s = 1;
  const auto step = gate.add(alive);
  ASSERT_TRUE(step);
  EXPECT_TRUE(step->has_gyro);
}

TEST(ReadingGate, CountsAndRatesInSeparateLines_FormOneIncrement) {
  const OdometryConfig config = small_robot();
  testing::DrivenRobot robot(config.geometry, {});
  ReadingGate gate(config);
  double gyro_rad = 0;
  int steps = 0;
  for (int i = 0; i < 100; ++i) {
    OdometryReading counts = robot.drive(0.01, 0.2, 0.5);
    const OdometryReading rate{counts.t_ns, {}, {}, counts.gyro_rad_s};
    counts.gyro_rad_s.reset();
    EXPECT_FALSE(gate.add(rate));
    if (i % 4 != 0) continue;
    const auto step = gate.add(counts);
    if (!step) continue;
    ++steps;
    EXPECT_TRUE(step->has_gyro);
    gyro_rad += step->gyro_rad;
  }
  EXPECT_EQ(steps, 24);
  EXPECT_NEAR(gyro_rad, 0.5 * 0.96, 1e-9);
}

TEST(ReadingGate, AnyReadings_IncrementsArePossible) {
  const OdometryConfig config = small_robot();
  std::mt19937_64 random(9);
  ReadingGate gate(config);
  TimeNs t_ns = 0;
  for (int i = 0; i < 100000; ++i) {
    OdometryReading reading;
    t_ns += static_cast<TimeNs>(random() % 200) * kMillisecond_ns - 20 * kMillisecond_ns;
    reading.t_ns = random() % 100 == 0 ? static_cast<TimeNs>(random() >> 2) : t_ns;
    if (random() % 10 != 0) reading.left = static_cast<std::int64_t>(random() >> (random() % 64));
    if (random() % 10 != 0) reading.right = static_cast<std::int64_t>(random() >> (random() % 64));
    if (random() % 3 != 0) reading.gyro_rad_s = std::bit_cast<double>(random());
    const auto step = gate.add(reading.arrived(t_ns));
    if (!step) continue;
    ASSERT_GT(step->to_ns, step->from_ns);
    ASSERT_LE(std::abs(step->left_m), 3 * step->duration_s() + 0.001);
    ASSERT_LE(std::abs(step->right_m), 3 * step->duration_s() + 0.001);
    ASSERT_LE(std::abs(step->gyro_rad), 35.0 * std::max(step->duration_s(), 0.0) + 1e-9);
  }
}

}  // namespace
}  // namespace cornerd::core
