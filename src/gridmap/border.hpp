// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// A border between free and occupied cells, along their sides, with free cells on the left.
/// Occupied cells that touch at a corner are connected.
struct Border {
  struct Point {
    std::int32_t x = 0;
    std::int32_t y = 0;
    bool operator==(const Point&) const = default;
    core::Vec2 place() const { return {x, y}; }
  };
  /// Corners of cells, each one cell side from the last. A closed border ends where it begins.
  std::vector<Point> points;
  bool closed = false;

  /// Number of sides.
  std::size_t size() const { return points.size() - 1; }
  /// Middle of a side.
  core::Vec2 middle(std::size_t side) const {
    return (points[side].place() + points[side + 1].place()) / 2;
  }
};

/// All borders of a grid. A border ends where unknown cells begin.
std::vector<Border> trace_borders(const OccupancyGrid& grid);

}  // namespace cornerd::gridmap
