// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// Rows from the top down: # occupied, ? unknown, all else free.
inline OccupancyGrid sketch(const std::vector<std::string>& lines) {
  OccupancyGrid grid(lines.front().size(), lines.size());
  for (std::size_t line = 0; line < lines.size(); ++line) {
    for (std::size_t column = 0; column < lines[line].size(); ++column) {
      const char c = lines[line][column];
      grid.set(static_cast<std::int64_t>(column), grid.rows() - 1 - static_cast<std::int64_t>(line),
               c == '#'   ? Cell::kOccupied
               : c == '?' ? Cell::kUnknown
                          : Cell::kFree);
    }
  }
  return grid;
}

}  // namespace cornerd::gridmap
