// SPDX-License-Identifier: MIT
// Drives through buildings whose maps are drawn by hand.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/localization/pose_score.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::bench {

struct DrawnPlanResult {
  PoseScore first;  ///< the first minute, from an unknown pose
  PoseScore later;  ///< the second minute
  /// Mean position errors of the second minutes after the best rigid alignment of each to the
  /// truth: a plan that is off as a whole fixes the frame.
  std::vector<double> aligned_errors_m;
};

struct DrawnPlanCase {
  bool learns_walls = false;
  bool has_odometry = true;  ///< of miscalibrated_robot()
};

/// A drive of two minutes at up to 0.4 m/s, added to `result`. `map`: of `building`, with errors.
void drive_in_drawn_plan(const std::shared_ptr<const core::WallMap>& building,
                         const std::shared_ptr<const core::WallMap>& map, std::uint64_t seed,
                         const DrawnPlanCase& test_case, DrawnPlanResult& result);

}  // namespace cornerd::bench
