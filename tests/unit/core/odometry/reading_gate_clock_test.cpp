// SPDX-License-Identifier: MIT
// Readings that come late, early, or by a clock that is set.
#include <gtest/gtest.h>

#include <vector>

#include "gated_drive.hpp"

namespace cornerd::core {
namespace {

using testing::drive_with;
using testing::kLeft_m;
using testing::kMillisecond_ns;
using testing::Outcome;
using testing::small_robot;

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
    const auto step = gate.add(reading.arrived(robot.now_ns()));
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
    gate.add(reading.arrived(newest_sample_ns));
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
    gate.add(reading.arrived(newest_sample_ns));
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
    gate.add(reading.arrived(reading.t_ns - ahead_ms * kMillisecond_ns));
  }
  EXPECT_EQ(gate.counters().future, 1U);
}

TEST(ReadingGate, ReadingsHeldBack_ArrivalTimesAreRejected) {
  // Ten readings are held back and arrive within 2 ms, stamped on arrival.
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
    steps += gate.add(reading.arrived(reading.t_ns)).has_value();
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
      return gate.add(reading.arrived(reading.t_ns)).has_value();
    };
    for (int i = 0; i < 100; ++i) add(0.02);
    int steps = 0;
    for (int i = 0; i < 20; ++i) steps += add(slow_s);
    EXPECT_EQ(steps, 18) << slow_s;
    EXPECT_EQ(gate.counters().future, 0U) << slow_s;
  }
}

}  // namespace
}  // namespace cornerd::core
