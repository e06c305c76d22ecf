// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/geometry/angle.hpp"

namespace cornerd::core {

/// Systematic error of a lidar: measured = (1 + range_scale) * true + range_offset_m, at a bearing
/// off by bearing_sine_rad * sin(bearing) + bearing_cosine_rad * cos(bearing), the eccentricity of
/// the angle disc. On hardware the bias dominates the pose error, not the noise: 1 % and 5 mm cost
/// 6 to 7 mm in rooms of a metre.
struct SensorBias {
  double range_scale = 0;
  double range_offset_m = 0;
  double bearing_sine_rad = 0;
  double bearing_cosine_rad = 0;

  bool operator==(const SensorBias&) const = default;
  bool is_none() const { return *this == SensorBias(); }
  double true_range_m(double measured_m) const {
    return (measured_m - range_offset_m) / (1 + range_scale);
  }
  /// Sine and cosine of the measured bearing are known to most callers.
  double true_bearing_rad(double claimed_rad, double sine, double cosine) const {
    return normalize_angle(claimed_rad - bearing_sine_rad * sine - bearing_cosine_rad * cosine);
  }
};

/// A bias estimated online, with its uncertainty.
struct EstimatedBias {
  SensorBias bias;
  SensorBias sigma;         ///< standard deviations
  std::size_t scans = 0;    ///< 0: `bias` is the configured prior
  bool is_limited = false;  ///< at the limit around the prior: the map is probably wrong
};

}  // namespace cornerd::core
