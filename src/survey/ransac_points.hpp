// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/localizer_config.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::survey {

/// A drive as wheels and gyro alone tell it, from a robot at the origin on.
struct ReckonedDrive {
  std::vector<core::Pose2> T_map_base;  ///< in the middle of each turn
  std::vector<core::Vec2> points;       ///< returns, in the map
};

/// `returns`: of each turn, evenly. Throws std::invalid_argument where there is no odometry.
ReckonedDrive reckon_drive(const RecordedDrive& drive, const core::LocalizerConfig& sensor,
                           std::size_t returns);

/// One point in each cell that has at least a fifth of what cells have on average: the mean of its
/// points. The longer the drive, the more cells have a stray return.
std::vector<core::Vec2> thin_out(const std::vector<core::Vec2>& points, double cell_m);

}  // namespace cornerd::survey
