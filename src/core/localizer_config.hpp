// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/geometry/pose2.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

enum class Method : std::uint8_t { kAltbd, kAbdIepf, kLineTracking };

struct DetectorConfig {
  Method method = Method::kAltbd;
  double sigma_offset = 0.04;        ///< share of the range (El Amin et al., step 5)
  double corner_tolerance_m = 0.23;  ///< Dth_corner: half a door of 46 cm (step 13)
};

struct LocalizerConfig {
  double min_range_m = 0.15;
  double max_range_m = 12.0;
  Pose2 T_base_lidar;
  DetectorConfig detector;
  SensorNoise noise;
};

}  // namespace cornerd::core
