// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// Where the robot was, by the lidar or by a truth.
struct KnownPose {
  core::TimeNs t_ns = 0;
  core::Pose2 T_map_base;
};

/// The steps between two known places, cut to them.
struct DriveWindow {
  std::vector<core::OdometryIncrement> steps;
  core::Pose2 way;          ///< as it was, from the first place to the second
  double rotation_rad = 0;  ///< as it was; may be more than half a turn
  double way_m = 0;         ///< along the arcs between the places meanwhile; backward is negative
};

/// The steps at the times when they were true, of readings that bear times `delay_s` later.
std::vector<core::OdometryIncrement> at_true_times(std::span<const core::OdometryIncrement> steps,
                                                   double delay_s);

/// Windows of about a second, one after another; those that holes or lost turns are in are left
/// out. Steps and places in the order of time.
std::vector<DriveWindow> cut_windows(std::span<const core::OdometryIncrement> steps,
                                     std::span<const KnownPose> places);

}  // namespace cornerd::calibration
