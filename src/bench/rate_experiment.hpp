// SPDX-License-Identifier: MIT
// What poses in motion are worth by how often wheels and gyro are read.
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

/// miscalibrated_robot() through the rooms of config/maps/flat-7.json at 0.25 m/s, with turns on
/// the spot at 1.5 rad/s; it starts and stops `gently` (gentle_drive) or at once. Same input, same
/// result.
RateResult run_rate_case(std::shared_ptr<const core::WallMap> map, double rate_hz, bool gently,
                         std::size_t scans, std::uint64_t seed);

}  // namespace cornerd::bench
