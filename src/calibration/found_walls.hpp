// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "calibration/bearing_bins.hpp"
#include "calibration/known_wall.hpp"

namespace cornerd::calibration {

/// The straight walls in a recording of a lidar that stands still: at least 20 degrees of it each,
/// the one that most directions see first. Their distances come from the returns themselves: an
/// offset of the range does not show in the errors, only how they depend on the ray.
std::vector<KnownWall> find_walls(std::span<const BinSpread> bins, std::span<const Return> returns);

}  // namespace cornerd::calibration
