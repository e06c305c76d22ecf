// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gridmap/occupancy_grid.hpp"
#include "gridmap/solids.hpp"

namespace cornerd::gridmap {

/// A line with free space on its left. In cells.
struct SurfaceLine {
  core::Vec2 at = core::Vec2::Zero();
  core::Vec2 direction = core::Vec2::Zero();  ///< unit vector

  core::Vec2 normal() const { return core::rotate_left(direction); }
  double height_of(const core::Vec2& point) const { return normal().dot(point - at); }
  double along(const core::Vec2& point) const { return direction.dot(point - at); }
};

/// The side of an occupied cell towards a free one.
struct Side {
  std::size_t index = 0;
  core::Vec2 middle = core::Vec2::Zero();
  core::Vec2 normal = core::Vec2::Zero();  ///< into the free cell
};

/// All sides between free and occupied cells, by place. Each may be taken once, by a line.
class Surface {
 public:
  explicit Surface(const OccupancyGrid& grid);

  const OccupancyGrid& grid() const { return grid_; }

  bool is_taken(const Side& side) const {
    return (open_[side.index / 4] >> side.index % 4 & 1) == 0;
  }
  void take(const Side& side) {
    open_[side.index / 4] &= static_cast<std::uint8_t>(~(1U << side.index % 4));
  }

  /// Calls visit(side) for the sides of a cell that no line took.
  template <typename Visitor>
  void for_each_side(std::int64_t column, std::int64_t row, Visitor&& visit) const {
    if (!grid_.holds(column, row)) return;
    const auto cell = static_cast<std::size_t>(row * grid_.columns() + column);
    if (open_[cell] == 0) return;
    for (std::size_t direction = 0; direction < 4; ++direction) {
      if ((open_[cell] >> direction & 1) == 0) continue;
      const core::Vec2 normal = kNormals[direction];
      visit(Side{4 * cell + direction, middle_of(column, row) + normal / 2, normal});
    }
  }

  static core::Vec2 middle_of(std::int64_t column, std::int64_t row) {
    return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
  }

  static inline const core::Vec2 kNormals[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

 private:
  const OccupancyGrid& grid_;
  std::vector<std::uint8_t> open_;  ///< for each occupied cell, a bit for each side
};

/// The slices of the raster across a line: columns or rows, whichever the line crosses more of.
class Slices {
 public:
  explicit Slices(const SurfaceLine& line)
      : line_(line), major_(std::abs(line.direction.x()) >= std::abs(line.direction.y()) ? 0 : 1) {}

  /// Length of the line within a slice.
  double step() const { return 1 / std::abs(line_.direction[major_]); }
  std::int64_t slice_of(double along) const {
    return static_cast<std::int64_t>(
        std::floor(line_.at[major_] + along * line_.direction[major_]));
  }
  /// Coordinate along the line of a slice's middle.
  double along(std::int64_t slice) const {
    return (static_cast<double>(slice) + 0.5 - line_.at[major_]) / line_.direction[major_];
  }
  /// +1 where slices ascend along the line.
  std::int64_t sense() const { return line_.direction[major_] > 0 ? 1 : -1; }

  /// Calls visit(slice) along a part of the line.
  template <typename Visitor>
  void for_each(const Interval& extent, Visitor&& visit) const {
    const std::int64_t last = slice_of(extent.end);
    for (std::int64_t slice = slice_of(extent.begin);; slice += sense()) {
      visit(slice);
      if (slice == last) return;
    }
  }
  /// Calls visit(column, row) for the cells of a slice that are within `reach` of the line.
  template <typename Visitor>
  void for_each_cell(std::int64_t slice, double reach, Visitor&& visit) const {
    const double middle = (line_.at + along(slice) * line_.direction)[1 - major_];
    const double half = reach * step();
    const auto last = static_cast<std::int64_t>(std::floor(middle + half));
    for (auto i = static_cast<std::int64_t>(std::floor(middle - half)); i <= last; ++i) {
      if (major_ == 0) {
        visit(slice, i);
      } else {
        visit(i, slice);
      }
    }
  }

 private:
  SurfaceLine line_;
  int major_;
};

}  // namespace cornerd::gridmap
