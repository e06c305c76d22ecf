// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "calibration/odometry_fit.hpp"
#include "core/odometry/odometry_config.hpp"

namespace cornerd::calibration {

/// What the fusion filter makes of a drive: taught by its known places for a while, then alone.
struct FilteredDrive {
  DriveError alone;                ///< after what taught it
  std::vector<core::Vec2> points;  ///< at each known place, before that place is told
  core::OdometryParameters learned;
  std::uint64_t slips = 0;
};

/// `taught_until_ns`: of the known places, those up to then teach. Steps and places in the order of
/// time.
FilteredDrive filter_drive(std::span<const core::OdometryIncrement> steps,
                           std::span<const KnownPose> places, const core::OdometryConfig& config,
                           core::TimeNs taught_until_ns);

}  // namespace cornerd::calibration
