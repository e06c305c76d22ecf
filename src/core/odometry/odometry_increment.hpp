// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// Increment of wheels and gyro between two readings, by the configured geometry.
struct OdometryIncrement {
  TimeNs from_ns = 0;
  TimeNs to_ns = 0;
  double left_m = 0;
  double right_m = 0;
  double jitter_s2 = 0;  ///< variance of a time within it
  double gyro_rad = 0;   ///< integral of the gyro's rate
  double gyro_change_rad =
      0;  ///< bound of the integration error by the rate's change within the increment
  bool has_gyro = false;
  bool gyro_may_be_stuck = false;  ///< the rate repeats to the bit
  bool is_gap = false;             ///< no valid readings of this time

  double duration_s() const { return to_seconds(to_ns - from_ns); }
  double translation_m() const { return (left_m + right_m) / 2; }

  /// Splits off the first part, up to `t_ns`; this becomes the rest. Rates are taken as constant.
  OdometryIncrement split(TimeNs t_ns) {
    OdometryIncrement first = *this;
    const double share = static_cast<double>(t_ns - from_ns) / static_cast<double>(to_ns - from_ns);
    first.to_ns = from_ns = t_ns;
    first.left_m *= share;
    first.right_m *= share;
    first.gyro_rad *= share;
    left_m -= first.left_m;
    right_m -= first.right_m;
    gyro_rad -= first.gyro_rad;
    first.gyro_change_rad *= share;
    gyro_change_rad -= first.gyro_change_rad;
    return first;
  }
};

/// Bertocco et al., equation 3: translation along the midpoint heading.
inline Pose2 arc(double translation_m, double rotation_rad) {
  return {translation_m * std::cos(rotation_rad / 2), translation_m * std::sin(rotation_rad / 2),
          normalize_angle(rotation_rad)};
}

}  // namespace cornerd::core
