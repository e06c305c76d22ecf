// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/detector_config.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/sensor_bias.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// How corners are recognised without a prior: by the catalogue's index of pairs with all corners
/// voting, or by the three stages of El Amin et al.
enum class RecognitionMethod : std::uint8_t { kPatterns, kPaper };

struct LocalizerConfig {
  double min_range_m = 0.15;
  double max_range_m = 12.0;
  Pose2 T_base_lidar;
  DetectorConfig detector;
  RecognitionMethod recognition = RecognitionMethod::kPatterns;
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
