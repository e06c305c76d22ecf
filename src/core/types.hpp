// SPDX-License-Identifier: MIT
// The words that every layer shares: time, a sample of the sensor, a reading of the odometry.
#pragma once

#include <cstdint>

namespace cornerd::core {

/// Nanoseconds. The core never asks what time it is; whoever feeds it brings the time along, on a
/// clock of its own choice (UNIX time live, time since the start in a replay).
using TimeNs = std::int64_t;

inline constexpr TimeNs kNsPerSecond = 1'000'000'000;

constexpr double to_seconds(TimeNs t_ns) { return static_cast<double>(t_ns) * 1e-9; }
constexpr TimeNs from_seconds(double t_s) {
  return static_cast<TimeNs>(t_s * 1e9 + (t_s < 0 ? -0.5 : 0.5));
}

/// One measurement of the lidar, in the lidar's frame (REP 103: x forward, counter-clockwise).
struct Sample {
  TimeNs t_ns = 0;
  float bearing_rad = 0;  ///< in [-pi, pi]
  float range_m = 0;      ///< 0: nothing returned
  std::uint8_t quality = 0;
  bool starts_scan = false;  ///< the first sample of a revolution
  bool ends_scan = false;    ///< the last one, where the source knows: a recorded SCAN does
};

}  // namespace cornerd::core
