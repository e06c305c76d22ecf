// SPDX-License-Identifier: MIT
#include "tool/drawing/survey_drawing.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tool/drawing/map_drawing.hpp"
#include "tool/drawing/svg.hpp"
#include "tool/drawing/text_table.hpp"

namespace cornerd::tool {

std::string survey_drawing(const survey::SurveyResult& result) {
  const core::WallMap map(result.plan);
  MapDrawing drawing(map);
  drawing.add_points(result.points);
  for (const survey::ThinPlace& place : result.thin) drawing.add_thin(place.from, place.to);
  std::vector<core::Vec2> path;
  for (const core::Pose2& T_map_base : result.T_map_base) path.push_back(T_map_base.translation());
  drawing.add_path(path);
  if (!result.T_map_base.empty()) drawing.add_pose(result.T_map_base.front());
  return drawing.document(
      formatted("%zu walls from %zu scans; green: returns; orange: without observations",
                result.plan.walls.size(), result.T_map_base.size()));
}

std::string ransac_canvas(const survey::SurveyResult& result) {
  constexpr double kCanvasPx = 1024;
  constexpr double kMarginPx = 12;
  const core::WallMap map(result.plan);
  core::Vec2 low = map.lower_left();
  core::Vec2 high = map.upper_right();
  for (const core::Vec2& point : result.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double side_m = std::max((high - low).maxCoeff(), 1e-3);
  high = low + core::Vec2(side_m, side_m);
  Svg svg(low, high, (kCanvasPx - 2 * kMarginPx) / side_m, kMarginPx);
  for (const core::Vec2& point : result.points) svg.dot(point, 0.7, {.fill = "#777777"});
  for (const core::Wall& wall : result.plan.walls) {
    svg.line(wall.from, wall.to, {.stroke = "#0000ff", .stroke_width = 2});
  }
  return svg.document(result.plan.name);
}

}  // namespace cornerd::tool
