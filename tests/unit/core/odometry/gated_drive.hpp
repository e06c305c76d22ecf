// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "core/odometry/reading_gate.hpp"
#include "driven_robot.hpp"

namespace cornerd::core::testing {

constexpr TimeNs kMillisecond_ns = 1'000'000;

inline OdometryConfig small_robot() {
  OdometryConfig config;
  config.enabled = true;
  config.geometry.counter_max = 65535;
  return config;
}

/// The gate's output for a steady drive of 3 s with one reading replaced.
struct Outcome {
  double left_m = 0;
  double gyro_rad = 0;
  int steps = 0;
  int holes = 0;
  OdometryCounters counters;
};
inline Outcome drive_with(const std::function<void(int, OdometryReading&)>& spoil) {
  const OdometryConfig config = small_robot();
  DrivenRobot robot(config.geometry, {});
  ReadingGate gate(config);
  Outcome outcome;
  for (int i = 0; i < 150; ++i) {
    OdometryReading reading = robot.drive(0.02, 0.3, 0.1);
    spoil(i, reading);
    const auto step = gate.add(reading.arrived(robot.now_ns()));
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

}  // namespace cornerd::core::testing
