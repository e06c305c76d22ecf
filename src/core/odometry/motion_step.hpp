// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::core {

/// What wheels and gyro did between two readings, by the geometry that was configured.
struct MotionStep {
  TimeNs from_ns = 0;
  TimeNs to_ns = 0;
  double left_m = 0;
  double right_m = 0;
  double gyro_rad = 0;         ///< the gyro's rate, integrated
  double gyro_change_rad = 0;  ///< what the rate's change within the step may add to it or take
  bool has_gyro = false;
  bool gyro_may_be_stuck = false;  ///< it says the same again and again
  bool is_hole = false;  ///< nothing is known of this time: readings were missing or garbage

  double duration_s() const { return to_seconds(to_ns - from_ns); }
  double way_m() const { return (left_m + right_m) / 2; }

  /// The first part of it, up to `t_ns`; this becomes the rest. The rates are taken as even.
  MotionStep split(TimeNs t_ns) {
    MotionStep first = *this;
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

/// Bertocco et al., equation 3: the way is taken in the direction half-way through the turn.
inline Pose2 arc(double way_m, double rotation_rad) {
  return {way_m * std::cos(rotation_rad / 2), way_m * std::sin(rotation_rad / 2),
          normalize_angle(rotation_rad)};
}

}  // namespace cornerd::core
