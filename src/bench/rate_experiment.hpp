// SPDX-License-Identifier: MIT
// Accuracy of poses in motion by the rate of the odometry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "bench/localization/pose_score.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// Readings a second; 0: the lidar alone.
inline constexpr double kReadingRates_hz[] = {0, 3, 5, 7, 10, 20, 50};

struct RateResult {
  PoseScore fixes;
  PoseScore predicted;
  double worst_fix_m = 0;
  double worst_fix_rad = 0;
  double worst_predicted_rad = 0;
  std::size_t scans = 0;
};

/// miscalibrated_robot() in config/maps/flat-7.json at 0.25 m/s, with rotations on the spot at 1.5
/// rad/s. It accelerates `gently` (gentle_drive) or abruptly. Deterministic.
RateResult run_rate_case(std::shared_ptr<const core::WallMap> map, double rate_hz, bool gently,
                         std::size_t scans, std::uint64_t seed);

}  // namespace cornerd::bench
