// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/odometry/odometry_config.hpp"

namespace cornerd::core {

/// What was refused, by cause.
struct OdometryCounters {
  std::uint64_t readings = 0;
  std::uint64_t past = 0;      ///< before the last one, long before now, or held back
  std::uint64_t future = 0;    ///< well after now, or ahead of the readings that followed
  std::uint64_t jumps = 0;     ///< more counts than a wheel can turn
  std::uint64_t gyro = 0;      ///< rates that are none
  std::uint64_t frozen = 0;    ///< rates that stay the same to the bit while the wheels turn
  std::uint64_t holes = 0;     ///< times of which nothing is known
  std::uint64_t restarts = 0;  ///< counts or times that went on somewhere else
};

/// For STATUS: what comes in, and what has been learned of the robot.
struct OdometrySummary {
  bool enabled = false;
  bool present = false;  ///< readings come
  bool trusted = false;  ///< and agree with the lidar and each other
  LearnedOdometry learned;
  LearnedOdometry sigma;  ///< of the learned ones
  OdometryCounters counters;
  std::uint64_t slips = 0;
  std::uint64_t fixes = 0;      ///< of the lidar that taught
  std::uint64_t strangers = 0;  ///< that no motion of the wheels could explain
};

}  // namespace cornerd::core
