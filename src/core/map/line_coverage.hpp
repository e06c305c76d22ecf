// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/map/outline.hpp"
#include "core/map/visible_parts.hpp"

namespace cornerd::core {

/// The parts of lines that line walls cover. Line walls hide each other only on the same line: this
/// finds those without comparing a wall with all that cross it. A wall costs the logarithm of the
/// number of walls, and the number of directions within kGeometryEpsilon_m per length of its own.
class LineCoverage {
 public:
  /// What the walls added so far cover of an edge.
  std::vector<Interval> of(const Vec2& from, const Vec2& to) const;

  void add(const WallBox& box);

 private:
  /// Direction in multiples of 1e-9 rad, from 0 to pi, and distance of the origin, m.
  using Key = std::pair<std::int64_t, double>;

  struct Line {
    WallBox first;                       ///< its frame
    std::map<double, double> covered{};  ///< begins and ends, disjoint, m along `first`

    void cover(double begin_m, double end_m);
  };

  /// Calls visit(line, local coordinates of `from` and `to`) for the lines within
  /// kGeometryEpsilon_m of both points.
  template <typename Visitor>
  static void visit_lines(auto& lines, const Vec2& from, const Vec2& to, Visitor&& visit);

  std::multimap<Key, Line> lines_;
};

}  // namespace cornerd::core
