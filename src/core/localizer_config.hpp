// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/detector_config.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/sensor_bias.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// A search that ends in one scan.
inline constexpr std::size_t kWholeSearch = 1U << 18U;
/// One beside a lidar in real time: 3 million instructions.
inline constexpr std::size_t kSearchInRealTime = 4096;

struct LocalizerConfig {
  double min_range_m = 0.15;
  double max_range_m = 12.0;
  Pose2 T_base_lidar;
  DetectorConfig detector;
  SensorNoise noise;
  SensorBias bias;               ///< prior, from the config
  bool calibrate_online = true;  ///< estimate the bias from scans at known poses
  bool forget_bias = true;       ///< exponential forgetting, since a lidar ages
  bool learn_walls = false;      ///< estimate the walls' offsets where the map states a sigma
  OdometryConfig odometry;
  /// Poses per scan of a robot whose pose is known: one at the scan's end, one per partial scan
  /// before.
  std::size_t updates_per_scan = 1;
  /// Nodes of the search of the map that a scan may cost: a search goes on over the next scans.
  std::size_t search_nodes_per_scan = kWholeSearch;
};

}  // namespace cornerd::core
