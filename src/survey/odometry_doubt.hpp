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

/// Wheels that told another story than the lidar, or none.
struct OdometryDoubt {
  std::size_t contradicted_scans = 0;
  std::size_t scans_without_odometry = 0;  ///< for which there were no readings
  WheelWay left;
  WheelWay right;
};

/// More turns than those that wheels which slip now and then do not lead to.
bool are_too_many(std::size_t unbelieved, std::size_t scans);

/// `T_map_base`: of each turn of the drive, in its middle.
/// `doubt`: with its turns; gets its ways.
void measure_wheels(const RecordedDrive& drive, std::span<const core::Pose2> T_map_base,
                    const core::OdometryConfig& config, OdometryDoubt& doubt);

}  // namespace cornerd::survey
