// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// A pose at which the scan may have been taken, and the number of breakpoints that support it.
struct PoseHypothesis {
  Pose2 T_map_lidar;
  int votes = 0;
};

/// Most votes first. Ties are broken by the pose, so that results are the same on every machine.
inline bool is_better(const PoseHypothesis& a, const PoseHypothesis& b) {
  if (a.votes != b.votes) return a.votes > b.votes;
  if (a.T_map_lidar.x_m != b.T_map_lidar.x_m) return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
  if (a.T_map_lidar.y_m != b.T_map_lidar.y_m) return a.T_map_lidar.y_m < b.T_map_lidar.y_m;
  return a.T_map_lidar.theta_rad < b.T_map_lidar.theta_rad;
}

/// Number of hypotheses with at least `share` of the best one's votes.
inline std::size_t count_likely(std::span<const PoseHypothesis> hypotheses, double share) {
  std::size_t count = 0;
  while (count < hypotheses.size() && hypotheses[count].votes >= share * hypotheses.front().votes) {
    ++count;
  }
  return count;
}

}  // namespace cornerd::core
