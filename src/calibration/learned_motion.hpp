// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/motion_step.hpp"
#include "core/odometry/odometry_config.hpp"

namespace cornerd::calibration {

/// Turn and way of a step with what was learned.
struct Moved {
  double way_m = 0;
  double wheel_turn_rad = 0;
  double turn_rad = 0;
};

inline Moved moved_by(const core::MotionStep& step, const core::DriveGeometry& geometry,
                      const core::LearnedOdometry& learned) {
  const double left_m = step.left_m * (1 + learned.left_scale);
  const double right_m = step.right_m * (1 + learned.right_scale);
  Moved moved;
  moved.way_m = (left_m + right_m) / 2;
  moved.wheel_turn_rad = (right_m - left_m) / (geometry.track_m * (1 + learned.track_scale));
  moved.turn_rad = step.has_gyro ? (step.gyro_rad - learned.gyro_bias_rad_s * step.duration_s()) /
                                       (1 + learned.gyro_scale)
                                 : moved.wheel_turn_rad;
  return moved;
}

}  // namespace cornerd::calibration
