// SPDX-License-Identifier: MIT
#include "core/map/line_coverage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace cornerd::core {
namespace {

/// A wall this near to a line has no line of its own.
constexpr double kSameLine_m = kGeometryEpsilon_m / 10;

/// Of a line in either orientation: from 0 to pi.
double direction_rad(const Vec2& along) {
  const double angle_rad = std::atan2(along.y(), along.x());
  return angle_rad < 0 ? angle_rad + kPi : angle_rad;
}

/// Directions are distinguished in steps of this.
constexpr double kDirection_rad = 1e-9;

std::int64_t multiple_of_direction(double angle_rad) {
  return static_cast<std::int64_t>(std::floor(angle_rad / kDirection_rad));
}

}  // namespace

template <typename Visitor>
void LineCoverage::visit_lines(auto& lines, const Vec2& from, const Vec2& to, Visitor&& visit) {
  constexpr double kAny = -std::numeric_limits<double>::infinity();
  const Vec2 way = to - from;
  const double tolerance_rad = std::min(1.0, 1.01 * kGeometryEpsilon_m / way.norm());
  // A line's direction is rounded.
  const double window_m = 1.01 * kGeometryEpsilon_m + 1.01 * kDirection_rad * from.norm();
  const double angle_rad = direction_rad(way);
  for (const double turn_rad : {-kPi, 0.0, kPi}) {
    const std::int64_t last = multiple_of_direction(angle_rad + turn_rad + tolerance_rad);
    auto i = lines.lower_bound({multiple_of_direction(angle_rad + turn_rad - tolerance_rad), kAny});
    while (i != lines.end() && i->first.first <= last) {
      const std::int64_t direction = i->first.first;
      const Vec2 along = unit_vector(static_cast<double>(direction) * kDirection_rad);
      const double offset_m = cross(along, from);
      i = lines.lower_bound({direction, offset_m - window_m});
      for (; i != lines.end() && i->first <= Key(direction, offset_m + window_m); ++i) {
        const Vec2 a = i->second.first.to_local(from);
        const Vec2 b = i->second.first.to_local(to);
        if (std::abs(a.y()) <= kGeometryEpsilon_m && std::abs(b.y() - a.y()) < kGeometryEpsilon_m) {
          visit(i->second, a, b);
        }
      }
      i = lines.lower_bound({direction + 1, kAny});
    }
  }
}

void LineCoverage::Line::cover(double begin_m, double end_m) {
  auto next = covered.upper_bound(begin_m);
  if (next != covered.begin() && std::prev(next)->second >= begin_m) {
    --next;
    begin_m = next->first;
  }
  while (next != covered.end() && next->first <= end_m) {
    end_m = std::max(end_m, next->second);
    next = covered.erase(next);
  }
  covered.emplace_hint(next, begin_m, end_m);
}

std::vector<Interval> LineCoverage::of(const Vec2& from, const Vec2& to) const {
  std::vector<Interval> found;
  visit_lines(lines_, from, to, [&](const Line& line, const Vec2& a, const Vec2& b) {
    const double way_m = b.x() - a.x();
    const double last_m = std::max(a.x(), b.x());
    auto i = line.covered.upper_bound(std::min(a.x(), b.x()));
    if (i != line.covered.begin()) --i;
    for (; i != line.covered.end() && i->first < last_m; ++i) {
      const double one = (i->first - a.x()) / way_m;
      const double other = (i->second - a.x()) / way_m;
      found.push_back({std::max(0.0, std::min(one, other)), std::min(1.0, std::max(one, other))});
    }
  });
  return found;
}

void LineCoverage::add(const WallBox& box) {
  const Vec2 half = box.half_length_m * box.along;
  bool has_line = false;
  const auto cover = [&](Line& line, const Vec2& a, const Vec2& b) {
    line.cover(std::min(a.x(), b.x()) - kGeometryEpsilon_m,
               std::max(a.x(), b.x()) + kGeometryEpsilon_m);
    has_line |= std::max(std::abs(a.y()), std::abs(b.y())) < kSameLine_m;
  };
  visit_lines(lines_, box.centre - half, box.centre + half, cover);
  if (has_line) return;
  const double angle_rad = direction_rad(box.along);
  const double offset_m = cross(box.along, box.centre);
  const bool is_turned = unit_vector(angle_rad).dot(box.along) < 0;
  const Key key(multiple_of_direction(angle_rad), is_turned ? -offset_m : offset_m);
  lines_.emplace(key, Line{box})
      ->second.cover(-box.half_length_m - kGeometryEpsilon_m,
                     box.half_length_m + kGeometryEpsilon_m);
}

}  // namespace cornerd::core
