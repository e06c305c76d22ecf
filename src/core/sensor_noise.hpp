// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "core/geometry/angle.hpp"
#include "core/sigma_table.hpp"

namespace cornerd::core {

/// Noise of a return: the range along the ray, the bearing across it. The defaults fit static A1s
/// in living rooms: 1.5 mm below 1 m, 2.3 mm at 1-2 m, 5.6 mm at 2-4 m.
struct SensorNoise {
  double floor_m = 0.0015;
  double share = 0.005;  ///< of the range
  double bearing_rad = radians(0.05);
  SigmaTable table{};  ///< replaces floor and share where it is not empty

  double sigma_range_m(double range_m) const {
    return table.empty() ? std::max(floor_m, share * range_m) : table.sigma_m(range_m);
  }

  /// Variance of a return's distance to its wall, m^2. `sine`: of the angle between ray and wall.
  /// At grazing incidence the bearing's noise counts, at normal incidence the range's.
  double variance_across_m2(double range_m, double sine) const {
    const double along = sigma_range_m(range_m) * sine;
    const double aside_m = bearing_rad * range_m;
    return along * along + aside_m * aside_m * (1 - sine * sine);
  }
};

}  // namespace cornerd::core
