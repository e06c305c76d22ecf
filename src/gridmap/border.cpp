// SPDX-License-Identifier: MIT
#include "gridmap/border.hpp"

#include <array>

namespace cornerd::gridmap {
namespace {

using Point = Border::Point;

/// East, north, west, south: a turn to the left is one more.
constexpr std::array<Point, 4> kWays = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
/// The cell to the left of the side that begins at a point, by its way; the one to the right is the
/// left one of the way before.
constexpr std::array<Point, 4> kLeftCell = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};

class Tracer {
 public:
  explicit Tracer(const OccupancyGrid& grid)
      : grid_(grid),
        passed_(static_cast<std::size_t>((grid.columns() + 1) * (grid.rows() + 1)), 0) {}

  std::vector<Border> trace() {
    // Those with a beginning first: whatever is left then is closed.
    for_each_side([&](const Point& at, unsigned way) {
      if (!has_side_before(at, way)) borders_.push_back(follow(at, way));
    });
    for_each_side([&](const Point& at, unsigned way) {
      if (is_passed(at, way)) return;
      borders_.push_back(follow(at, way));
      borders_.back().closed = true;
    });
    return std::move(borders_);
  }

 private:
  bool is_side(const Point& at, unsigned way) const {
    const Point& left = kLeftCell[way];
    const Point& right = kLeftCell[(way + 3) % 4];
    return grid_.at(at.x + left.x, at.y + left.y) == Cell::kFree &&
           grid_.at(at.x + right.x, at.y + right.y) == Cell::kOccupied;
  }

  /// The way on after a side that ends here; 4 where there is none.
  unsigned way_on(const Point& at, unsigned way) const {
    for (const unsigned scan : {1U, 0U, 3U}) {
      if (is_side(at, (way + scan) % 4)) return (way + scan) % 4;
    }
    return 4;
  }

  bool has_side_before(const Point& at, unsigned way) const {
    for (const unsigned scan : {0U, 1U, 3U}) {
      const unsigned before = (way + scan) % 4;
      const Point from{at.x - kWays[before].x, at.y - kWays[before].y};
      if (is_side(from, before) && way_on(at, before) == way) return true;
    }
    return false;
  }

  Border follow(Point at, unsigned way) {
    Border border;
    border.points.push_back(at);
    while (way < 4 && !is_passed(at, way)) {
      passed_[index(at)] |= static_cast<std::uint8_t>(1U << way);
      at = {at.x + kWays[way].x, at.y + kWays[way].y};
      border.points.push_back(at);
      way = way_on(at, way);
    }
    return border;
  }

  template <typename Visitor>
  void for_each_side(Visitor&& visit) {
    for (std::int32_t y = 0; y <= grid_.rows(); ++y) {
      for (std::int32_t x = 0; x <= grid_.columns(); ++x) {
        for (unsigned way = 0; way < 4; ++way) {
          if (is_side({x, y}, way)) visit(Point{x, y}, way);
        }
      }
    }
  }

  std::size_t index(const Point& at) const {
    return static_cast<std::size_t>(at.y * (grid_.columns() + 1) + at.x);
  }
  bool is_passed(const Point& at, unsigned way) const {
    return (passed_[index(at)] >> way & 1U) != 0;
  }

  const OccupancyGrid& grid_;
  std::vector<std::uint8_t> passed_;  ///< of each corner of cells: a bit for each way from it
  std::vector<Border> borders_;
};

}  // namespace

std::vector<Border> trace_borders(const OccupancyGrid& grid) { return Tracer(grid).trace(); }

}  // namespace cornerd::gridmap
