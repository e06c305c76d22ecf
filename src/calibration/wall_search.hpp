// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "calibration/bearing_bins.hpp"
#include "calibration/wall_model.hpp"

namespace cornerd::calibration {

/// A straight wall in a recording, at a distance that was measured by other means.
struct KnownWall {
  double distance_m = 0;   ///< as told
  double bearing_rad = 0;  ///< of the wall's normal, from the lidar to the wall
  double measured_m =
      0;  ///< the distance by the median of the returns up to 15 degrees off the normal
  std::vector<WallReturn> returns;
};

/// The wall whose returns fit a line at that distance best; nullopt where next to none do. Its
/// direction comes from the same returns: an error that grows evenly from one side of the wall to
/// the other cannot be told from it, and counts as direction.
std::optional<KnownWall> find_known_wall(std::span<const Return> returns, double distance_m);

/// The straight walls in a recording of a lidar that stands still: at least 20 degrees of it each,
/// the one that most directions see first. Their distances come from the returns themselves: an
/// offset of the range does not show in the errors, only how they depend on the ray.
std::vector<KnownWall> find_walls(std::span<const BinSpread> bins, std::span<const Return> returns);

}  // namespace cornerd::calibration
