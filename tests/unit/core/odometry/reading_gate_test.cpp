// SPDX-License-Identifier: MIT
#include "core/odometry/reading_gate.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "driven_robot.hpp"

namespace cornerd::core {
namespace {

constexpr TimeNs kMillisecond_ns = 1'000'000;

OdometryConfig small_robot() {
  OdometryConfig config;
  config.enabled = true;
  config.geometry.counter_max = 65535;
  return config;
}

/// What the gate makes of a steady drive of 3 s with one reading replaced.
struct Outcome {
  double left_m = 0;
  double gyro_rad = 0;
  int steps = 0;
  int holes = 0;
  OdometryCounters counters;
};
Outcome drive_with(const std::function<void(int, OdometryReading&)>& spoil) {
  const OdometryConfig config = small_robot();
  testing::DrivenRobot robot(config.geometry, {});
  ReadingGate gate(config);
  Outcome outcome;
  for (int i = 0; i < 150; ++i) {
    OdometryReading reading = robot.drive(0.02, 0.3, 0.1);
    spoil(i, reading);
    const auto step = gate.add(reading, robot.now_ns());
    if (!step) continue;
    ++outcome.steps;
    outcome.holes += step->is_gap;
    outcome.left_m += step->left_m;
    outcome.gyro_rad += step->gyro_rad;
  }
  outcome.counters = gate.counters();
  return outcome;
}

constexpr double kLeft_m = (0.3 - 0.1 * 0.08) * 0.02 * 149;

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

TEST(ReadingGate, FarFutureAndPast_AreRejected) {
  const Outcome outcome = drive_with([](int i, OdometryReading& reading) {
    if (i == 40) reading.t_ns += 3600 * kNsPerSecond;
    if (i == 60) reading.t_ns -= 100 * kMillisecond_ns;
    if (i == 80) reading.t_ns -= 3600 * kNsPerSecond;
    if (i == 90) reading.t_ns -= 20 * kMillisecond_ns;
  });
  EXPECT_EQ(outcome.counters.future, 1U);
  EXPECT_EQ(outcome.counters.past, 3U);
  EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001);
}

TEST(ReadingGate, ClockSetBack_IsFollowedLater) {
  const Outcome outcome = drive_with([](int i, OdometryReading& reading) {
    if (i >= 50) reading.t_ns -= 2 * kNsPerSecond;
  });
  EXPECT_EQ(outcome.counters.restarts, 1U);
  EXPECT_GT(outcome.left_m, 0.7 * kLeft_m);
}

TEST(ReadingGate, ClockSetBack_GapEndsBeforeItBegins) {
  testing::DrivenRobot robot(small_robot().geometry, {});
  ReadingGate gate(small_robot());
  std::vector<OdometryIncrement> back;
  for (int i = 0; i < 150; ++i) {
    OdometryReading reading = robot.drive(0.02, 0.3, 0.1);
    if (i >= 50) reading.t_ns -= kNsPerSecond;
    const auto step = gate.add(reading, robot.now_ns());
    if (step && step->to_ns < step->from_ns) back.push_back(*step);
  }
  ASSERT_EQ(back.size(), 1U);
  EXPECT_TRUE(back.front().is_gap);
}

TEST(ReadingGate, OneFutureReading_OnlyItIsRejected) {
  for (const int ahead_ms : {100, 200, 300, 1000, 1900}) {
    const Outcome outcome = drive_with([&](int i, OdometryReading& reading) {
      if (i == 60) reading.t_ns += ahead_ms * kMillisecond_ns;
    });
    EXPECT_EQ(outcome.counters.future, 1U) << ahead_ms;
    EXPECT_EQ(outcome.counters.past, 0U) << ahead_ms;
    EXPECT_EQ(outcome.holes, 0) << ahead_ms;
    EXPECT_EQ(outcome.steps, 148) << ahead_ms;
    EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001) << ahead_ms;
  }
}

TEST(ReadingGate, Pause_EndsWithNextReadings) {
  const Outcome outcome = drive_with([](int i, OdometryReading& reading) {
    if (i > 50 && i < 75) reading.t_ns -= 3600 * kNsPerSecond;
  });
  EXPECT_EQ(outcome.counters.future, 0U);
  EXPECT_EQ(outcome.holes, 0);
  EXPECT_EQ(outcome.steps, 149 - 24 - 2);
  EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001);
}

TEST(ReadingGate, ClockLeapsAhead_RejectedUntilItReturns) {
  for (const int ahead_ms : {300, 600, 1500, 5000}) {
    const Outcome outcome = drive_with([&](int i, OdometryReading& reading) {
      if (i >= 50 && i < 80) reading.t_ns += ahead_ms * kMillisecond_ns;
    });
    EXPECT_EQ(outcome.counters.future, 30U) << ahead_ms;
    EXPECT_EQ(outcome.counters.restarts, 0U) << ahead_ms;
    EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001) << ahead_ms;
  }
}

TEST(ReadingGate, ClockAlwaysAhead_IsRejectedLater) {
  const Outcome outcome =
      drive_with([](int, OdometryReading& reading) { reading.t_ns += kNsPerSecond; });
  EXPECT_GT(outcome.counters.future, 50U);
  EXPECT_LT(outcome.steps, 100);
}

TEST(ReadingGate, ScansInOnePiece_NoFutureReadings) {
  testing::DrivenRobot robot(small_robot().geometry, {});
  ReadingGate gate(small_robot());
  TimeNs newest_sample_ns = 0;
  for (int i = 0; i < 500; ++i) {
    const OdometryReading reading = robot.drive(0.02, 0.3, 0.1);
    gate.add(reading, newest_sample_ns);
    if (i % 50 == 49) newest_sample_ns = reading.t_ns;
  }
  EXPECT_EQ(gate.counters().future, 0U);
}

TEST(ReadingGate, PauseWithScansInOnePiece_IsNoClockLeap) {
  testing::DrivenRobot robot(small_robot().geometry, {});
  ReadingGate gate(small_robot());
  TimeNs newest_sample_ns = 0;
  for (int i = 0; i < 60; ++i) {
    const OdometryReading reading = robot.drive(i % 10 == 9 ? 0.5 : 0.18, 0.3, 0.1);
    gate.add(reading, newest_sample_ns);
    newest_sample_ns = reading.t_ns;
  }
  EXPECT_EQ(gate.counters().future, 0U);
  EXPECT_EQ(gate.counters().gaps, 0U);
}

TEST(ReadingGate, AheadOfLimit_IsRejected) {
  OdometryConfig config = small_robot();
  config.limits.ahead_s = 0.25;
  ReadingGate gate(config);
  testing::DrivenRobot robot(config.geometry, {});
  for (const int ahead_ms : {240, 260}) {
    const OdometryReading reading = robot.drive(0.02, 0.3, 0.1);
    gate.add(reading, reading.t_ns - ahead_ms * kMillisecond_ns);
  }
  EXPECT_EQ(gate.counters().future, 1U);
}

TEST(ReadingGate, ReadingsHeldBack_ArrivalTimesAreRejected) {
  // Ten of them wait, and come within 2 ms, as stamped on arrival.
  const TimeNs let_go_ns = [] {
    testing::DrivenRobot robot(small_robot().geometry, {});
    TimeNs t_ns = 0;
    for (int i = 0; i <= 60; ++i) t_ns = robot.drive(0.02, 0.3, 0.1).t_ns;
    return t_ns;
  }();
  const Outcome outcome = drive_with([&](int i, OdometryReading& reading) {
    if (i >= 50 && i < 60) reading.t_ns = let_go_ns - (60 - i) * kMillisecond_ns / 5;
  });
  EXPECT_EQ(outcome.counters.jumps, 0U);
  EXPECT_EQ(outcome.counters.restarts, 0U);
  EXPECT_EQ(outcome.holes, 0);
  EXPECT_GE(outcome.counters.past, 8U);
  EXPECT_NEAR(outcome.left_m, kLeft_m, 0.001);
}

TEST(ReadingGate, SparseReadings_AreNoLeaps) {
  testing::DrivenRobot robot(small_robot().geometry, {});
  ReadingGate gate(small_robot());
  int steps = 0;
  for (int i = 0; i < 20; ++i) {
    const OdometryReading reading = robot.drive(i % 2 == 0 ? 0.4 : 0.6, 0.3, 0.1);
    steps += gate.add(reading, reading.t_ns).has_value();
  }
  EXPECT_EQ(steps, 19);
  EXPECT_EQ(gate.counters().future, 0U);
}

TEST(ReadingGate, ClientSlowsDown_IsFollowed) {
  for (const double slow_s : {0.1, 0.2, 0.5}) {
    testing::DrivenRobot robot(small_robot().geometry, {});
    ReadingGate gate(small_robot());
    const auto add = [&](double dt_s) {
      const OdometryReading reading = robot.drive(dt_s, 0.3, 0.1);
      return gate.add(reading, reading.t_ns).has_value();
    };
    for (int i = 0; i < 100; ++i) add(0.02);
    int steps = 0;
    for (int i = 0; i < 20; ++i) steps += add(slow_s);
    EXPECT_EQ(steps, 18) << slow_s;
    EXPECT_EQ(gate.counters().future, 0U) << slow_s;
  }
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
    const auto step = gate.add(reading, std::nullopt);
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
    const auto step = gate.add(reading, std::nullopt);
    with_gyro += step && step->has_gyro;
  }
  EXPECT_LT(with_gyro, 15);

  OdometryReading alive = robot.drive(0.02, 0.2, 1);
  alive.gyro_rad_s = 1;
  const auto step = gate.add(alive, std::nullopt);
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
    EXPECT_FALSE(gate.add(rate, std::nullopt));
    if (i % 4 != 0) continue;
    const auto step = gate.add(counts, std::nullopt);
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
    const auto step = gate.add(reading, t_ns);
    if (!step) continue;
    ASSERT_GT(step->to_ns, step->from_ns);
    ASSERT_LE(std::abs(step->left_m), 3 * step->duration_s() + 0.001);
    ASSERT_LE(std::abs(step->right_m), 3 * step->duration_s() + 0.001);
    ASSERT_LE(std::abs(step->gyro_rad), 35.0 * std::max(step->duration_s(), 0.0) + 1e-9);
  }
}

}  // namespace
}  // namespace cornerd::core
