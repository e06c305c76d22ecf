// SPDX-License-Identifier: MIT
#include "plan/line_merging.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace cornerd::plan {

namespace {

using core::Vec2;

constexpr double kSamePoint_m = 1e-3;
constexpr double kSameDirection_rad = 1e-3;

/// Lines of about one direction and offset; `along` is not turned.
using Key = std::array<std::int64_t, 2>;

Line with_length(const Vec2& from, const Vec2& to) {
  const Vec2 displacement = to - from;
  const double length_m = displacement.norm();
  return {from, length_m > 0 ? Vec2(displacement / length_m) : Vec2::UnitX(), length_m};
}

/// Both lie on one line, and touch.
bool continues(const Line& line, const Line& next) {
  if (std::abs(core::cross(line.along, next.along)) > kSameDirection_rad) return false;
  if (std::abs(core::cross(line.along, next.from - line.from)) > kSamePoint_m) return false;
  return line.along.dot(next.from - line.from) <= line.length_m + kSamePoint_m;
}

}  // namespace

std::vector<Line> merge_lines(std::span<const DrawnLine> drawn) {
  std::map<Key, std::vector<Line>> groups;
  for (const DrawnLine& one : drawn) {
    const bool is_turned = one.to.x() < one.from.x() - kSamePoint_m ||
                           (one.to.x() < one.from.x() + kSamePoint_m && one.to.y() < one.from.y());
    const Line line = is_turned ? with_length(one.to, one.from) : with_length(one.from, one.to);
    if (line.length_m < kSamePoint_m) continue;
    const double direction_rad = std::atan2(line.along.y(), line.along.x());
    const double offset_m = core::cross(line.along, line.from);
    groups[{std::llround(direction_rad / (5 * kSameDirection_rad)),
            std::llround(offset_m / (2 * kSamePoint_m))}]
        .push_back(line);
  }
  std::vector<Line> merged;
  for (auto& [key, lines] : groups) {
    std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
      return a.along.dot(a.from) < b.along.dot(b.from);
    });
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (i == 0 || !continues(merged.back(), lines[i])) {
        merged.push_back(lines[i]);
        continue;
      }
      Line& last = merged.back();
      const double reach_m = last.along.dot(lines[i].to() - last.from);
      if (reach_m > last.length_m) last = with_length(last.from, lines[i].to());
    }
  }
  return merged;
}

}  // namespace cornerd::plan
