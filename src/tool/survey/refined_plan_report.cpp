// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tool/drawing/text_table.hpp"
#include "tool/survey/survey_files.hpp"

namespace cornerd::tool {
namespace {

std::string place_of(const core::Vec2& from, const core::Vec2& to) {
  return formatted("from %.2f,%.2f to %.2f,%.2f", from.x(), from.y(), to.x(), to.y());
}

std::string describe_moves(const core::FloorPlan& drawn, const survey::RefinedPlan& refined) {
  std::vector<double> moved_m;
  for (const double by_m : refined.moved_m) moved_m.push_back(std::abs(by_m));
  std::sort(moved_m.begin(), moved_m.end());
  if (moved_m.empty()) return "no wall of the plan was seen\n";
  return formatted(
      "%zu of %zu walls of the plan were seen; they moved by %.0f mm in the median, "
      "%.0f mm at most\n",
      moved_m.size(), drawn.walls.size(), 1e3 * moved_m[moved_m.size() / 2], 1e3 * moved_m.back());
}

}  // namespace

std::string refined_plan_report(const core::FloorPlan& drawn, const survey::RefinedPlan& refined) {
  std::string text = describe_moves(drawn, refined);
  for (const survey::PlanPart& part : refined.contradicted) {
    text += formatted("not there: wall %zu of the plan, ", part.wall) +
            place_of(part.from, part.to) + ": rays went through\n";
  }
  for (const core::Wall& wall : refined.added) {
    text += "new: a wall " + place_of(wall.from, wall.to) + "\n";
  }
  for (const survey::PlanPart& part : refined.unseen) {
    text += formatted("not seen: wall %zu of the plan, ", part.wall) +
            place_of(part.from, part.to) + ": kept as drawn\n";
  }
  return text;
}

}  // namespace cornerd::tool
