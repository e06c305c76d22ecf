// SPDX-License-Identifier: MIT
#include "core/map/cell_grid.hpp"

#include <limits>
#include <numeric>

namespace cornerd::core {
namespace {

/// Margin against rounding: an item is entered into every cell this near to it.
constexpr double kCellSlack_m = 1e-5;
constexpr double kMinCell_m = 0.1;
/// Limits of the grid's size: cells, and entries in all cells, per item.
constexpr std::size_t kCellsPerItem = 4;
constexpr std::size_t kEntriesPerItem = 16;
constexpr std::size_t kFewItems = 16;

}  // namespace

Extent Extent::of_segment(const Vec2& from, const Vec2& to, double half_width_m) {
  Extent extent;
  const Vec2 margin = Vec2::Constant(half_width_m);
  extent.low = from.cwiseMin(to) - margin;
  extent.high = from.cwiseMax(to) + margin;
  const Vec2 displacement = to - from;
  if (const double length_m = displacement.norm(); length_m > 0) {
    extent.normal = rotate_left(displacement) / length_m;
    extent.offset_m = extent.normal.dot(from);
    extent.half_width_m = half_width_m;
  }
  return extent;
}

CellGrid::CellGrid(std::span<const Extent> extents) {
  if (extents.empty()) return;
  Vec2 low = extents.front().low;
  Vec2 high = extents.front().high;
  for (const Extent& extent : extents) {
    low = low.cwiseMin(extent.low);
    high = high.cwiseMax(extent.high);
  }
  lower_left_ = low - Vec2::Constant(2 * kCellSlack_m);
  const Vec2 size = high - lower_left_ + Vec2::Constant(2 * kCellSlack_m);
  const std::size_t items = extents.size() + kFewItems;
  cell_m_ =
      std::max(kMinCell_m, std::sqrt(size.x() * size.y() / static_cast<double>(extents.size())));
  while (true) {
    const Vec2 cells = (size / cell_m_).array().floor() + 1;
    if (cells.x() * cells.y() <= static_cast<double>(kCellsPerItem * items)) {
      columns_ = static_cast<std::size_t>(cells.x());
      rows_ = static_cast<std::size_t>(cells.y());
      if (fill(extents, kEntriesPerItem * items) || columns_ * rows_ == 1) return;
    }
    cell_m_ *= 2;
  }
}

template <typename Visitor>
bool CellGrid::cover(const Extent& extent, Visitor&& visit) const {
  const std::size_t first_column = column_of(extent.low.x() - kCellSlack_m);
  const std::size_t last_column = column_of(extent.high.x() + kCellSlack_m);
  const std::size_t last_row = row_of(extent.high.y() + kCellSlack_m);
  for (std::size_t row = row_of(extent.low.y() - kCellSlack_m); row <= last_row; ++row) {
    std::size_t begin = first_column;
    std::size_t end = last_column;
    if (extent.normal.x() != 0) {
      // Where the strip crosses this row.
      const double y = lower_left_.y() + static_cast<double>(row) * cell_m_;
      const double at_bottom = extent.offset_m - extent.normal.y() * y;
      const double at_top = at_bottom - extent.normal.y() * cell_m_;
      const double aside = extent.half_width_m + kCellSlack_m;
      const double one = std::min(at_bottom, at_top) - aside;
      const double other = std::max(at_bottom, at_top) + aside;
      const double x0 = one / extent.normal.x();
      const double x1 = other / extent.normal.x();
      begin = std::max(begin, column_of(std::min(x0, x1)));
      end = std::min(end, column_of(std::max(x0, x1)));
    }
    for (std::size_t column = begin; column <= end; ++column) {
      if (!visit(row * columns_ + column)) return false;
    }
  }
  return true;
}

bool CellGrid::fill(std::span<const Extent> extents, std::size_t limit) {
  first_.assign(columns_ * rows_ + 1, 0);
  std::size_t entries = 0;
  for (const Extent& extent : extents) {
    const bool fits = cover(extent, [&](std::size_t cell) {
      ++first_[cell + 1];
      return ++entries <= limit;
    });
    if (!fits && columns_ * rows_ > 1) return false;
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  items_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < extents.size(); ++i) {
    cover(extents[i], [&](std::size_t cell) {
      items_[next[cell]++] = static_cast<std::uint32_t>(i);
      return true;
    });
  }
  return true;
}

void CellGrid::collect(const Extent& extent, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (columns_ == 0) return;
  cover(extent, [&](std::size_t cell) {
    found.insert(found.end(), items_.begin() + first_[cell], items_.begin() + first_[cell + 1]);
    return true;
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

CellGrid::Walk CellGrid::begin_walk(const Vec2& origin, const Vec2& ray, double max_range_m) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  Walk w;
  if (columns_ == 0) return w;
  const Vec2 start = origin - lower_left_;
  const Vec2 size(static_cast<double>(columns_) * cell_m_, static_cast<double>(rows_) * cell_m_);
  double enter_m = 0;
  double leave_m = max_range_m;
  for (int axis = 0; axis < 2; ++axis) {
    if (ray[axis] == 0) {
      if (start[axis] < 0 || start[axis] >= size[axis]) return w;
      continue;
    }
    const double low_m = -start[axis] / ray[axis];
    const double high_m = (size[axis] - start[axis]) / ray[axis];
    enter_m = std::max(enter_m, std::min(low_m, high_m));
    leave_m = std::min(leave_m, std::max(low_m, high_m));
  }
  if (!(enter_m <= leave_m)) return w;
  const Vec2 entry = start + enter_m * ray;
  w.inside = true;
  w.column = index_of(entry.x(), columns_);
  w.row = index_of(entry.y(), rows_);
  w.step_x = ray.x() > 0 ? 1 : -1;
  w.step_y = ray.y() > 0 ? 1 : -1;
  const double border_x = static_cast<double>(w.column + (ray.x() > 0 ? 1 : 0)) * cell_m_;
  const double border_y = static_cast<double>(w.row + (ray.y() > 0 ? 1 : 0)) * cell_m_;
  w.next_x_m = ray.x() == 0 ? kNever : (border_x - start.x()) / ray.x();
  w.next_y_m = ray.y() == 0 ? kNever : (border_y - start.y()) / ray.y();
  w.column_m = ray.x() == 0 ? kNever : cell_m_ / std::abs(ray.x());
  w.row_m = ray.y() == 0 ? kNever : cell_m_ / std::abs(ray.y());
  return w;
}

void CellGrid::step(Walk& w, double max_range_m) const {
  if (std::min(w.next_x_m, w.next_y_m) > max_range_m) {
    w.inside = false;
  } else if (w.next_x_m < w.next_y_m) {
    w.next_x_m += w.column_m;
    w.inside = w.step_x > 0 ? w.column + 1 < columns_ : w.column > 0;
    w.column += static_cast<std::size_t>(w.step_x);
  } else {
    w.next_y_m += w.row_m;
    w.inside = w.step_y > 0 ? w.row + 1 < rows_ : w.row > 0;
    w.row += static_cast<std::size_t>(w.step_y);
  }
}

std::size_t CellGrid::memory_bytes() const {
  return (first_.capacity() + items_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace cornerd::core
