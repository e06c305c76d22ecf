// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

struct CellIndex {
  std::int64_t column;
  std::int64_t row;
};

/// Straight neighbours first.
inline constexpr std::array<CellIndex, 8> kNeighbours = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// Calls visit(cells of the patch) for every patch of the kind.
template <typename Visitor>
void for_each_patch(const OccupancyGrid& grid, Cell kind, std::size_t neighbours, Visitor&& visit) {
  std::vector<bool> seen(static_cast<std::size_t>(grid.columns() * grid.rows()), false);
  std::vector<CellIndex> patch;
  const auto take = [&](std::int64_t column, std::int64_t row) {
    if (grid.at(column, row) != kind) return;
    const auto i = static_cast<std::size_t>(row * grid.columns() + column);
    if (seen[i]) return;
    seen[i] = true;
    patch.push_back({column, row});
  };
  for (std::int64_t row = 0; row < grid.rows(); ++row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      patch.clear();
      take(column, row);
      for (std::size_t i = 0; i < patch.size(); ++i) {
        const CellIndex at = patch[i];
        for (std::size_t n = 0; n < neighbours; ++n) {
          take(at.column + kNeighbours[n].column, at.row + kNeighbours[n].row);
        }
      }
      if (!patch.empty()) visit(patch);
    }
  }
}

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

/// The grid in larger cells: occupied where any of their cells is, unknown where all are.
OccupancyGrid coarser(const OccupancyGrid& grid, std::int64_t factor);

/// Share of the occupied cells with occupied cells all around, which no beam can have ended in.
double buried_share(const OccupancyGrid& grid);

}  // namespace cornerd::gridmap
