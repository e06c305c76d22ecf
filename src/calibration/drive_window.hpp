// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// A pose of the robot from the lidar, or from ground truth.
struct KnownPose {
  core::TimeNs t_ns = 0;
  core::Pose2 T_map_base;
};

/// The odometry increments between two known poses.
struct DriveWindow {
  std::vector<core::OdometryIncrement> steps;
  core::Pose2 motion;       ///< true motion from the first pose to the second
  double rotation_rad = 0;  ///< true rotation, not wrapped
  double distance_m = 0;  ///< true distance along the arcs between the poses; backward is negative
};

/// The increments at their true times, for readings whose times are `delay_s` late.
std::vector<core::OdometryIncrement> at_true_times(std::span<const core::OdometryIncrement> steps,
                                                   double delay_s);

/// Consecutive windows of about a second, without those that have a gap in the increments or in
/// the poses. `steps` and `places` are sorted by time.
std::vector<DriveWindow> cut_windows(std::span<const core::OdometryIncrement> steps,
                                     std::span<const KnownPose> places);

}  // namespace cornerd::calibration
