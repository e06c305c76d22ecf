// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "gridmap/faces.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// Moves the ends of faces to where they meet others: within `reach` cells, or as far as `hidden`
/// cells where no free cell is in between.
void join_corners(const OccupancyGrid& grid, double reach, double hidden,
                  std::vector<GridFace>& faces);

}  // namespace cornerd::gridmap
