// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// A place where the turn may have been taken, and how many breakpoints speak for it.
struct Hypothesis {
  Pose2 T_map_lidar;
  int votes = 0;
};

/// Best voted first. Ties are broken by the place, so that equal input gives equal output on every
/// machine.
inline bool is_better(const Hypothesis& a, const Hypothesis& b) {
  if (a.votes != b.votes) return a.votes > b.votes;
  if (a.T_map_lidar.x_m != b.T_map_lidar.x_m) return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
  if (a.T_map_lidar.y_m != b.T_map_lidar.y_m) return a.T_map_lidar.y_m < b.T_map_lidar.y_m;
  return a.T_map_lidar.theta_rad < b.T_map_lidar.theta_rad;
}

/// How many of them, best voted first, have at least `share` of the best one's votes.
inline std::size_t count_likely(std::span<const Hypothesis> hypotheses, double share) {
  std::size_t count = 0;
  while (count < hypotheses.size() && hypotheses[count].votes >= share * hypotheses.front().votes) {
    ++count;
  }
  return count;
}

}  // namespace cornerd::core
