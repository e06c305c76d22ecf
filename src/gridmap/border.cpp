// SPDX-License-Identifier: MIT
#include "gridmap/border.hpp"

#include <array>

namespace cornerd::gridmap {
namespace {

using Point = Border::Point;

/// East, north, west, south: a left turn adds one.
constexpr std::array<Point, 4> kDirections = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
/// The cell on the left of the side that begins at a point, by direction; the one on the right is
/// the left one of the direction before.
constexpr std::array<Point, 4> kLeftCell = {{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};

class Tracer {
 public:
  explicit Tracer(const OccupancyGrid& grid)
      : grid_(grid),
        passed_(static_cast<std::size_t>((grid.columns() + 1) * (grid.rows() + 1)), 0) {}

  std::vector<Border> trace() {
    // Open borders first: the rest is closed.
    for_each_side([&](const Point& at, unsigned direction) {
      if (!has_side_before(at, direction)) borders_.push_back(follow(at, direction));
    });
    for_each_side([&](const Point& at, unsigned direction) {
      if (is_passed(at, direction)) return;
      borders_.push_back(follow(at, direction));
      borders_.back().closed = true;
    });
    return std::move(borders_);
  }

 private:
  bool is_side(const Point& at, unsigned direction) const {
    const Point& left = kLeftCell[direction];
    const Point& right = kLeftCell[(direction + 3) % 4];
    return grid_.at(at.x + left.x, at.y + left.y) == Cell::kFree &&
           grid_.at(at.x + right.x, at.y + right.y) == Cell::kOccupied;
  }

  /// Direction of the next side; 4 where there is none.
  unsigned next_direction(const Point& at, unsigned direction) const {
    for (const unsigned turn : {1U, 0U, 3U}) {
      if (is_side(at, (direction + turn) % 4)) return (direction + turn) % 4;
    }
    return 4;
  }

  bool has_side_before(const Point& at, unsigned direction) const {
    for (const unsigned turn : {0U, 1U, 3U}) {
      const unsigned before = (direction + turn) % 4;
      const Point from{at.x - kDirections[before].x, at.y - kDirections[before].y};
      if (is_side(from, before) && next_direction(at, before) == direction) return true;
    }
    return false;
  }

  Border follow(Point at, unsigned direction) {
    Border border;
    border.points.push_back(at);
    while (direction < 4 && !is_passed(at, direction)) {
      passed_[index(at)] |= static_cast<std::uint8_t>(1U << direction);
      at = {at.x + kDirections[direction].x, at.y + kDirections[direction].y};
      border.points.push_back(at);
      direction = next_direction(at, direction);
    }
    return border;
  }

  template <typename Visitor>
  void for_each_side(Visitor&& visit) {
    for (std::int32_t y = 0; y <= grid_.rows(); ++y) {
      for (std::int32_t x = 0; x <= grid_.columns(); ++x) {
        for (unsigned direction = 0; direction < 4; ++direction) {
          if (is_side({x, y}, direction)) visit(Point{x, y}, direction);
        }
      }
    }
  }

  std::size_t index(const Point& at) const {
    return static_cast<std::size_t>(at.y * (grid_.columns() + 1) + at.x);
  }
  bool is_passed(const Point& at, unsigned direction) const {
    return (passed_[index(at)] >> direction & 1U) != 0;
  }

  const OccupancyGrid& grid_;
  std::vector<std::uint8_t> passed_;  ///< for each cell corner, a bit for each direction
  std::vector<Border> borders_;
};

}  // namespace

std::vector<Border> trace_borders(const OccupancyGrid& grid) { return Tracer(grid).trace(); }

}  // namespace cornerd::gridmap
