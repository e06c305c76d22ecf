// SPDX-License-Identifier: MIT
// A uniform grid over the plane, as a spatial index.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// Extent of an item: an axis-aligned box, and within it only the strip within `half_width_m` of
/// the line normal.dot(p) = offset_m. A zero normal means the whole box.
struct Extent {
  Vec2 low = Vec2::Zero();
  Vec2 high = Vec2::Zero();
  Vec2 normal = Vec2::Zero();
  double offset_m = 0;
  double half_width_m = 0;

  static Extent of_segment(const Vec2& from, const Vec2& to, double half_width_m);
};

/// Square cells, each with the indices of the items that may touch it, ascending. Memory and time
/// are near-linear in the number of items. Immutable.
class CellGrid {
 public:
  CellGrid() = default;
  explicit CellGrid(std::span<const Extent> extents);

  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double cell_m() const { return cell_m_; }
  const Vec2& lower_left() const { return lower_left_; }
  std::size_t memory_bytes() const;

  std::span<const std::uint32_t> in_cell(std::size_t column, std::size_t row) const {
    const std::size_t cell = row * columns_ + column;
    return std::span(items_).subspan(first_[cell], first_[cell + 1] - first_[cell]);
  }

  /// Items of the cell that holds the point; none outside the grid.
  std::span<const std::uint32_t> at(const Vec2& point) const {
    const double x = (point.x() - lower_left_.x()) / cell_m_;
    const double y = (point.y() - lower_left_.y()) / cell_m_;
    if (!(x >= 0 && y >= 0 && x < static_cast<double>(columns_) && y < static_cast<double>(rows_)))
      return {};
    return in_cell(static_cast<std::size_t>(x), static_cast<std::size_t>(y));
  }

  /// Fills `found` with the items that may touch `extent`, ascending, each once.
  void collect(const Extent& extent, std::vector<std::uint32_t>& found) const;

  /// Calls visit(items of the cell, distance at which the ray leaves it) for the cells along a ray,
  /// until visit returns false or the ray is `max_range_m` long.
  template <typename Visitor>
  void walk(const Vec2& origin, const Vec2& ray, double max_range_m, Visitor&& visit) const {
    Walk w = begin_walk(origin, ray, max_range_m);
    while (w.inside) {
      if (!visit(in_cell(w.column, w.row), std::min(w.next_x_m, w.next_y_m))) return;
      step(w, max_range_m);
    }
  }

 private:
  struct Walk {
    bool inside = false;
    std::size_t column = 0;
    std::size_t row = 0;
    int step_x = 0;
    int step_y = 0;
    double next_x_m = 0;  ///< distance along the ray to the next column border
    double next_y_m = 0;
    double column_m = 0;  ///< distance along the ray between column borders
    double row_m = 0;
  };
  Walk begin_walk(const Vec2& origin, const Vec2& ray, double max_range_m) const;
  void step(Walk& w, double max_range_m) const;
  /// False where the entries would exceed `limit`.
  bool fill(std::span<const Extent> extents, std::size_t limit);

  std::size_t column_of(double x_m) const { return index_of(x_m - lower_left_.x(), columns_); }
  std::size_t row_of(double y_m) const { return index_of(y_m - lower_left_.y(), rows_); }
  std::size_t index_of(double distance_m, std::size_t count) const {
    if (!(distance_m > 0)) return 0;
    const double cell = distance_m / cell_m_;
    return cell < static_cast<double>(count - 1) ? static_cast<std::size_t>(cell) : count - 1;
  }
  template <typename Visitor>
  bool cover(const Extent& extent, Visitor&& visit) const;

  Vec2 lower_left_ = Vec2::Zero();
  double cell_m_ = 1;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< of each cell: its first entry in items_
  std::vector<std::uint32_t> items_;
};

}  // namespace cornerd::core
