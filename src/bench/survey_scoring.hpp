// SPDX-License-Identifier: MIT
// Accuracy and completeness of a surveyed map.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

struct SurveyScore {
  std::size_t walls_visible = 0;     ///< faces with at least 30 cm visible
  std::size_t walls_found = 0;       ///< of those: 95 % of the visible length is on the map's walls
  std::vector<core::Vec2> missed;    ///< centres of the others, in the true frame
  double seen_m = 0;                 ///< visible length of all faces
  double found_m = 0;                ///< of that, on the map's walls
  double invented_m = 0;             ///< length of the map's faces outside any true wall
  std::vector<core::Vec2> invented;  ///< points of that, in the true frame
  std::size_t corners_visible = 0;   ///< both walls visible up to the corner
  std::size_t corners_found = 0;
  std::vector<double> corner_errors_m;  ///< ascending
  core::Pose2 T_true_map;               ///< aligned on the corners

  double corner_median_m() const {
    return corner_errors_m.empty() ? 0 : corner_errors_m[corner_errors_m.size() / 2];
  }
  double corner_max_m() const { return corner_errors_m.empty() ? 0 : corner_errors_m.back(); }
};

/// `poses`: true poses of the lidar, one for each scan. `start`: initial guess of T_true_map.
SurveyScore score_survey(const core::WallMap& truth, std::span<const core::Pose2> poses,
                         const core::WallMap& found, const core::Pose2& start);

}  // namespace cornerd::bench
