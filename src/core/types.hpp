// SPDX-License-Identifier: MIT
// Types of all layers: time and a sample of the sensor.
#pragma once

#include <cstdint>

namespace cornerd::core {

/// Nanoseconds. The core reads no clock: callers pass times of a clock of their choice (monotonic
/// live, the recording's time in a replay).
using TimeNs = std::int64_t;

inline constexpr TimeNs kNsPerSecond = 1'000'000'000;

constexpr double to_seconds(TimeNs t_ns) { return static_cast<double>(t_ns) * 1e-9; }
constexpr TimeNs from_seconds(double t_s) {
  return static_cast<TimeNs>(t_s * 1e9 + (t_s < 0 ? -0.5 : 0.5));
}

/// One measurement in the lidar's frame (REP 103: x forward, counter-clockwise).
struct Sample {
  TimeNs t_ns = 0;
  float bearing_rad = 0;  ///< in [-pi, pi]
  float range_m = 0;      ///< 0: no return
  std::uint8_t quality = 0;
  bool starts_scan = false;  ///< the first sample of a revolution
  bool ends_scan = false;    ///< the last one, where the source marks it: a recorded SCAN does
};

}  // namespace cornerd::core
