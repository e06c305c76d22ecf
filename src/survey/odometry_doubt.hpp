// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::survey {

/// How far a wheel rolled, back and forth.
struct WheelWay {
  double counted_m = 0;  ///< by its counts and the config
  double true_m = 0;     ///< by the lidar and the configured track
};

/// Wheels that told another story than the lidar.
struct OdometryDoubt {
  std::size_t turns = 0;  ///< in which they were not believed
  WheelWay left;
  WheelWay right;
};

/// More turns than wheels that slip now and then contradict the lidar in.
bool is_too_often(std::size_t contradicted, std::size_t turns);

/// `T_map_base`: of each turn of the drive, in its middle.
OdometryDoubt doubt_of_wheels(const RecordedDrive& drive, std::size_t contradicted,
                              std::span<const core::Pose2> T_map_base,
                              const core::OdometryConfig& config);

}  // namespace cornerd::survey
