// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "core/map/wall_map.hpp"
#include "gridmap/faces.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// Marks the ends of walls that are only where the picture's knowledge ends: no free cell is seen
/// beyond the ends of their faces, and no other wall is there. In cells; `reach`: how far beyond.
void mark_open_ends(const OccupancyGrid& grid, std::span<const GridFace> faces, double reach,
                    std::span<core::Wall> walls);

}  // namespace cornerd::gridmap
