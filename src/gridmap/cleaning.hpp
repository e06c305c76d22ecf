// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// A connected component of cells of one kind.
struct Patch {
  std::size_t cells = 0;
  core::Vec2 centre = core::Vec2::Zero();  ///< in cells
  double size = 0;                         ///< longer side of its bounding box, in cells
};

/// Makes occupied patches smaller than `size` unknown (8-connected): specks, chair legs, people.
/// Returns them.
std::vector<Patch> drop_specks(OccupancyGrid& grid, double size);

/// Makes enclosed free patches of fewer than `cells` cells unknown (4-connected): seen through
/// glass or behind a wall. Returns them. The largest free patch stays.
std::vector<Patch> drop_pockets(OccupancyGrid& grid, std::size_t cells);

/// Share of the occupied cells with occupied cells all around, which no beam can have ended in.
double buried_share(const OccupancyGrid& grid);

}  // namespace cornerd::gridmap
