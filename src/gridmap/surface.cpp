// SPDX-License-Identifier: MIT
#include "gridmap/surface.hpp"

namespace cornerd::gridmap {

Surface::Surface(const OccupancyGrid& grid)
    : grid_(grid), open_(static_cast<std::size_t>(grid.columns() * grid.rows()), 0) {
  std::size_t cell = 0;
  for (std::int64_t row = 0; row < grid.rows(); ++row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column, ++cell) {
      if (grid.at(column, row) != Cell::kOccupied) continue;
      for (std::size_t direction = 0; direction < 4; ++direction) {
        const core::Vec2 beside = middle_of(column, row) + kNormals[direction];
        if (grid.at(beside) == Cell::kFree) {
          open_[cell] |= static_cast<std::uint8_t>(1U << direction);
        }
      }
    }
  }
}

}  // namespace cornerd::gridmap
