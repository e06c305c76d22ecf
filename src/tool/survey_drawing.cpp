// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "tool/map_drawing.hpp"
#include "tool/survey_files.hpp"
#include "tool/text_table.hpp"

namespace cornerd::tool {

std::string survey_drawing(const survey::SurveyResult& result) {
  const core::WallMap map(result.plan);
  MapDrawing drawing(map);
  drawing.add_points(result.points);
  for (const survey::ThinPlace& place : result.thin) drawing.add_thin(place.from, place.to);
  std::vector<core::Vec2> way;
  for (const core::Pose2& T_map_base : result.T_map_base) way.push_back(T_map_base.translation());
  drawing.add_path(way);
  if (!result.T_map_base.empty()) drawing.add_pose(result.T_map_base.front());
  return drawing.document(
      formatted("%zu walls from %zu turns; green: returns; orange: not seen, between what was",
                result.plan.walls.size(), result.T_map_base.size()));
}

}  // namespace cornerd::tool
