// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::tool {

struct DifferenceOptions {
  double reach_m = 0.3;        ///< a wall that is further away is another one
  double tolerance_m = 0.005;  ///< smaller differences are none
};

/// A wall of A that is elsewhere in B. Positive: to the left of its direction, and forward.
struct MovedWall {
  std::size_t wall = 0;        ///< of A
  std::size_t other_wall = 0;  ///< of B, the one that covers most of it
  double across_m = 0;
  double from_along_m = 0;
  double to_along_m = 0;
  double thicker_m = 0;
};

/// Walls by their index in their map.
struct MapDifference {
  std::vector<MovedWall> moved;
  std::vector<std::size_t> gone;   ///< of A: less than half of it is in B
  std::vector<std::size_t> added;  ///< of B: less than half of it is in A
};

/// Compares walls that are parallel within three degrees. Both maps are in one frame. A wall that
/// is drawn in pieces is the same wall.
MapDifference compare_maps(const core::FloorPlan& a, const core::FloorPlan& b,
                           const DifferenceOptions& options);

std::string difference_text(const core::FloorPlan& a, const core::FloorPlan& b,
                            const MapDifference& difference);
std::string difference_json(const core::FloorPlan& a, const core::FloorPlan& b,
                            const MapDifference& difference);

}  // namespace cornerd::tool
