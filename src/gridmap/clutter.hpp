// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/map/wall_map.hpp"
#include "gridmap/cleaning.hpp"
#include "gridmap/solids.hpp"

namespace cornerd::gridmap {

struct Clutter {
  std::vector<core::Wall> walls;  ///< in cells
  std::vector<Patch> dropped;
};

/// Rectangles for the occupied patches beside all walls and free cells: chair legs, table edges. A
/// patch that does not fill its rectangle is halved; parts shorter than `min_size` are dropped. The
/// surfaces are `inset` behind the outline. In cells.
Clutter box_clutter(const OccupancyGrid& grid, double min_size, double inset,
                    const SolidLimits& limits);

}  // namespace cornerd::gridmap
