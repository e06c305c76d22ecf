// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/detector_config.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/sensor_bias.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

struct LocalizerConfig {
  double min_range_m = 0.15;
  double max_range_m = 12.0;
  Pose2 T_base_lidar;
  DetectorConfig detector;
  SensorNoise noise;
  SensorBias bias;               ///< prior, from the config
  bool calibrate_online = true;  ///< estimate the bias from scans at known poses
  bool forget_bias = true;       ///< exponential forgetting, since a lidar ages
  OdometryConfig odometry;
  /// Poses per scan of a robot whose pose is known: one at the scan's end, one per partial scan
  /// before.
  std::size_t updates_per_scan = 1;
};

}  // namespace cornerd::core
