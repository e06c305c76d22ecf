// SPDX-License-Identifier: MIT
#include "gridmap/clutter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/breakpoint/line_fit.hpp"

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// Share of a rectangle's area that its occupied cells fill, at least.
constexpr double kFilled = 0.6;

class ClutterBoxes {
 public:
  ClutterBoxes(double min_size, double inset, const SolidLimits& limits)
      : min_size_(min_size), inset_(inset), limits_(limits) {}

  void add(std::vector<Vec2> cells) {
    core::LineFit fit(cells.front());
    for (const Vec2& cell : cells) fit.add(cell.x(), cell.y(), 1);
    const Vec2 axis = cells.size() < 2 ? Vec2(1, 0) : fit.line().direction();
    Vec2 low = Vec2::Constant(1e9);
    Vec2 high = -low;
    for (const Vec2& cell : cells) {
      const Vec2 local(axis.dot(cell), core::cross(axis, cell));
      low = low.cwiseMin(local);
      high = high.cwiseMax(local);
    }
    const Vec2 middle = (low + high) / 2;
    const Vec2 size = high - low + Vec2::Ones();
    const Vec2 place = middle.x() * axis + middle.y() * core::rotate_left(axis);
    if (size.x() < min_size_) {
      found_.dropped.push_back({cells.size(), place, size.x()});
      return;
    }
    if (static_cast<double>(cells.size()) >= kFilled * size.prod()) {
      const Vec2 solid = (size - Vec2::Constant(2 * inset_)).cwiseMax(0);
      const double thickness = solid.y() < limits_.min_thickness ? limits_.thin : solid.y();
      const Vec2 half = std::max(solid.x() - thickness, 0.0) / 2 * axis;
      if (solid.x() > 0) found_.walls.push_back({place - half, place + half, thickness});
      return;
    }
    const auto second = std::partition(
        cells.begin(), cells.end(), [&](const Vec2& cell) { return axis.dot(cell) < middle.x(); });
    add({second, cells.end()});
    cells.erase(second, cells.end());
    add(std::move(cells));
  }

  Clutter take() { return std::move(found_); }

 private:
  double min_size_;
  double inset_;
  const SolidLimits& limits_;
  Clutter found_;
};

}  // namespace

Clutter box_clutter(const OccupancyGrid& grid, double min_size, double inset,
                    const SolidLimits& limits) {
  ClutterBoxes boxes(min_size, inset, limits);
  for_each_patch(grid, Cell::kOccupied, 8, [&](const std::vector<CellIndex>& patch) {
    std::vector<Vec2> cells;
    bool is_seen = false;
    for (const CellIndex& cell : patch) {
      cells.emplace_back(static_cast<double>(cell.column) + 0.5,
                         static_cast<double>(cell.row) + 0.5);
      is_seen = is_seen || std::any_of(kNeighbours.begin(), kNeighbours.end(), [&](auto step) {
                  return grid.at(cell.column + step.column, cell.row + step.row) == Cell::kFree;
                });
    }
    if (is_seen) boxes.add(std::move(cells));
  });
  return boxes.take();
}

}  // namespace cornerd::gridmap
