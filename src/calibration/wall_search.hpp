// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "calibration/bearing_bins.hpp"
#include "calibration/wall_model.hpp"

namespace cornerd::calibration {

/// A straight wall in a recording, at a known distance.
struct KnownWall {
  double distance_m = 0;   ///< true distance
  double bearing_rad = 0;  ///< of the wall's normal, from the lidar to the wall
  double measured_m = 0;   ///< median of the returns up to 15 degrees off the normal
  std::vector<WallReturn> returns;
};

/// The wall whose returns fit a line at that distance best; nullopt where too few do. Its direction
/// comes from the same returns, so that it absorbs an error linear in the ray angle.
std::optional<KnownWall> find_known_wall(std::span<const Return> returns, double distance_m);

/// The straight walls of at least 20 degrees in a static recording, the one in most bins first.
/// Their distances come from the returns: the errors show how they depend on the ray, not a
/// constant offset.
std::vector<KnownWall> find_walls(std::span<const BinSpread> bins, std::span<const Return> returns);

}  // namespace cornerd::calibration
