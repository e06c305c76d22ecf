// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::survey {

/// Distance that a wheel rolled, forward and backward added up.
struct WheelDistance {
  double counted_m = 0;  ///< by its counts
  double lidar_m = 0;    ///< by the lidar and the configured track
};

/// Why a survey left the odometry out.
struct RejectedOdometry {
  std::size_t contradicted_scans = 0;
  std::size_t scans_without_odometry = 0;
  WheelDistance left;
  WheelDistance right;
};

/// More rejected scans than occasional wheel slip causes: a tenth of all.
bool exceeds_rejection_share(std::size_t rejected, std::size_t scans);

/// Fills in the distances of `rejected`. `T_map_base`: at the middle of each scan.
void measure_wheel_distances(const RecordedDrive& drive, std::span<const core::Pose2> T_map_base,
                             const core::OdometryConfig& config, RejectedOdometry& rejected);

}  // namespace cornerd::survey
