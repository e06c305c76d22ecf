// SPDX-License-Identifier: MIT
#include "gridmap/walls.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gridmap/solids.hpp"

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// Shortest rest of a face beside solids.
constexpr double kMinRest = 1;
/// A line that ends within this distance of a solid is extended to it.
constexpr double kReach = 1.5;
constexpr double kSamePoint = 1e-3;
constexpr double kMinLine = 0.05;

/// A part of a face that no solid covers.
struct Line {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  double depth = 0;      ///< of the occupied cells behind it
  bool touches = false;  ///< an end is in a solid
  bool enters_from = false;
  bool enters_to = false;
};

class LineFinder {
 public:
  LineFinder(const OccupancyGrid& grid, std::span<const core::Wall> solids,
             const SolidLimits& limits)
      : grid_(grid), limits_(limits) {
    for (const core::Wall& wall : solids) boxes_.emplace_back(wall);
  }

  void add(const GridFace& face) {
    const double length = face.length();
    std::vector<Interval> hidden;
    for (const core::WallBox& box : boxes_) {
      const Interval part = covered(face, box, limits_.tolerance);
      if (part.length() > 0) hidden.push_back(part);
    }
    for (Interval open : uncovered(length, std::move(hidden))) {
      const bool is_whole = open.length() >= length;
      if (!is_whole && open.length() < kMinRest) continue;
      bool touches = extend(face, open, false);
      touches = extend(face, open, true) || touches;
      if (open.length() < kMinLine) continue;
      Line line;
      line.from = face.from + open.begin * face.direction;
      line.to = face.from + open.end * face.direction;
      line.depth = face.is_joint || limits_.lines ? 0 : depth_behind(face, open);
      line.touches = touches;
      line.enters_from = open.begin == 0 && face.enters_from;
      line.enters_to = open.end == length && face.enters_to;
      lines_.push_back(line);
    }
  }

  std::vector<core::Wall> take(double min_size, std::vector<LeftOut>& left_out) {
    const std::vector<std::size_t> groups = group();
    std::vector<core::Wall> kept;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (groups[i] != i) continue;
      Vec2 low = lines_[i].from;
      Vec2 high = low;
      bool touches = false;
      for (std::size_t j = i; j < lines_.size(); ++j) {
        if (groups[j] != i) continue;
        low = low.cwiseMin(lines_[j].from).cwiseMin(lines_[j].to);
        high = high.cwiseMax(lines_[j].from).cwiseMax(lines_[j].to);
        touches = touches || lines_[j].touches;
      }
      if (!touches && (high - low).norm() < min_size) {
        left_out.push_back({(low + high) / 2, (high - low).norm()});
        continue;
      }
      for (std::size_t j = i; j < lines_.size(); ++j) {
        if (groups[j] == i) kept.push_back(thicken(lines_[j]));
      }
    }
    return kept;
  }

 private:
  /// Extends one end of an interval into a near solid. False where there is none.
  bool extend(const GridFace& face, Interval& open, bool at_end) const {
    const double end = at_end ? open.end : open.begin;
    const double sign = at_end ? 1 : -1;
    // The face's line, from the middle of the interval beyond its end.
    GridFace line = face;
    line.from = face.from + (open.begin + open.end) / 2 * face.direction;
    line.direction = sign * face.direction;
    const double to_end = sign * (end - (open.begin + open.end) / 2);
    line.to = line.from + (to_end + kReach) * line.direction;
    bool found = false;
    double nearest = to_end + kReach;
    for (const core::WallBox& box : boxes_) {
      const Interval inside = covered(line, box, 0);
      if (inside.length() <= 0 || inside.end < to_end - kReach) continue;
      found = true;
      nearest = std::min(nearest, inside.begin + std::min(limits_.into, inside.length() / 2));
    }
    if (!found) return false;
    const double beyond = nearest - to_end;
    (at_end ? open.end : open.begin) += sign * beyond;
    return true;
  }

  /// Depth of the occupied cells behind an interval (10 % quantile).
  double depth_behind(const GridFace& face, const Interval& open) const {
    constexpr double kStep = 0.5;
    std::vector<double> depths;
    for (double s = open.begin + kStep; s < open.end - kStep / 2; s += kStep) {
      const Vec2 surface = face.from + s * face.direction;
      double depth = 0;
      while (depth < limits_.thickness &&
             grid_.at(Vec2(surface - (depth + kStep / 2) * face.normal())) == Cell::kOccupied) {
        depth += kStep;
      }
      depths.push_back(depth);
    }
    if (depths.empty()) return 0;
    const auto few = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 10);
    std::nth_element(depths.begin(), few, depths.end());
    return std::min(*few, open.length());
  }

  /// A wall behind a line, with its front on the line.
  core::Wall thicken(const Line& line) const {
    if (line.depth < limits_.min_thickness) return {line.from, line.to, 0};
    const double half = line.depth / 2;
    const Vec2 direction = (line.to - line.from).normalized();
    const Vec2 middle = half * core::rotate_left(direction);
    // In a room's corner two walls meet in a point: overlap them, so that no ray passes.
    const double into = std::min(limits_.into, half);
    const double from = half - (line.enters_from ? into : 0);
    const double to = half - (line.enters_to ? into : 0);
    return {line.from + from * direction - middle, line.to - to * direction - middle, line.depth};
  }

  /// For each line, the first line of its connected group.
  std::vector<std::size_t> group() const {
    std::vector<std::size_t> first(lines_.size());
    std::iota(first.begin(), first.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
      while (first[i] != i) i = first[i];
      return i;
    };
    std::vector<core::Extent> extents;
    for (const Line& line : lines_) {
      extents.push_back(core::Extent::of_segment(line.from, line.to, 0));
    }
    const core::CellGrid places(extents);
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      for (const Vec2& end : {lines_[i].from, lines_[i].to}) {
        places.collect(core::Extent::of_segment(end, end, kSamePoint), near);
        for (const std::uint32_t j : near) {
          if (std::min((lines_[j].from - end).norm(), (lines_[j].to - end).norm()) > kSamePoint) {
            continue;
          }
          const std::size_t a = root(i);
          const std::size_t b = root(j);
          first[std::max(a, b)] = std::min(a, b);
        }
      }
    }
    for (std::size_t i = 0; i < first.size(); ++i) first[i] = root(i);
    return first;
  }

  const OccupancyGrid& grid_;
  const SolidLimits& limits_;
  std::vector<core::WallBox> boxes_;
  std::vector<Line> lines_;
};

}  // namespace

std::vector<core::Wall> find_one_sided(const OccupancyGrid& grid, std::span<const GridFace> faces,
                                       std::span<const core::Wall> solids,
                                       const SolidLimits& limits, double min_size,
                                       std::vector<LeftOut>& left_out) {
  LineFinder finder(grid, solids, limits);
  for (const GridFace& face : faces) finder.add(face);
  return finder.take(min_size, left_out);
}

}  // namespace cornerd::gridmap
