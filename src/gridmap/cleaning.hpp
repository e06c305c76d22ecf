// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// Cells of one kind that hang together.
struct Patch {
  std::size_t cells = 0;
  core::Vec2 centre = core::Vec2::Zero();  ///< in cells
  double size = 0;                         ///< longer side of the box around them, in cells
};

/// Makes unknown what is occupied and smaller than `size` both ways, diagonal neighbours included:
/// specks, legs of chairs, people. Returns what went.
std::vector<Patch> drop_specks(OccupancyGrid& grid, double size);

/// Makes unknown what is free, shut in, and has fewer than `cells` cells: what beams saw through
/// glass or behind a wall. Returns what went. The largest free patch stays.
std::vector<Patch> drop_pockets(OccupancyGrid& grid, std::size_t cells);

/// Share of the occupied cells that have occupied ones all around: where no beam ever ended.
double buried_share(const OccupancyGrid& grid);

}  // namespace cornerd::gridmap
