// SPDX-License-Identifier: MIT
// How near a surveyed map is to the building that was driven through.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

struct SurveyScore {
  std::size_t walls_seen = 0;        ///< faces of which at least 30 cm were seen
  std::size_t walls_found = 0;       ///< of those: 95 % of what was seen lies on the map's walls
  std::vector<core::Vec2> missed;    ///< middles of the others, in the true frame
  double seen_m = 0;                 ///< of all faces
  double found_m = 0;                ///< of that
  double invented_m = 0;             ///< of the map's faces: what is no wall, nor within one
  std::vector<core::Vec2> invented;  ///< some places of that, in the true frame
  std::size_t corners_seen = 0;      ///< both of whose walls were seen up to the corner
  std::size_t corners_found = 0;
  std::vector<double> corner_errors_m;  ///< ascending, of those found
  core::Pose2 T_true_map;               ///< the frames, aligned on the corners

  double corner_median_m() const {
    return corner_errors_m.empty() ? 0 : corner_errors_m[corner_errors_m.size() / 2];
  }
  double corner_max_m() const { return corner_errors_m.empty() ? 0 : corner_errors_m.back(); }
};

/// `places`: where the lidar truly was, a turn each. `start`: of the map's frame in the true one,
/// as far as it is known.
SurveyScore score_survey(const core::WallMap& truth, std::span<const core::Pose2> places,
                         const core::WallMap& found, const core::Pose2& start);

}  // namespace cornerd::bench
