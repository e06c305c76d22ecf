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
  SensorBias bias;          ///< as far as it is known beforehand
  bool learn_bias = true;   ///< the rest, from the turns whose place is known
  bool forget_bias = true;  ///< slowly, as a lidar ages; false: all turns tell the same
  OdometryConfig odometry;
  /// Poses of a robot whose place is known: each turn gives its own at its end, and one for each
  /// part before.
  std::size_t updates_per_scan = 1;
};

}  // namespace cornerd::core
