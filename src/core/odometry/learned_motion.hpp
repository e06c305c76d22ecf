// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/motion_step.hpp"
#include "core/odometry/odometry_config.hpp"

namespace cornerd::core {

/// What a step was by what is known of the robot.
struct LearnedMotion {
  double left_m = 0;
  double right_m = 0;
  double way_m = 0;
  double wheel_rotation_rad = 0;
  double rotation_rad = 0;  ///< the gyro's, or the wheels' where there is none
};

inline LearnedMotion learned_motion(const MotionStep& step, const DriveGeometry& geometry,
                                    const LearnedOdometry& learned) {
  LearnedMotion motion;
  motion.left_m = step.left_m * (1 + learned.left_scale);
  motion.right_m = step.right_m * (1 + learned.right_scale);
  motion.way_m = (motion.left_m + motion.right_m) / 2;
  motion.wheel_rotation_rad =
      (motion.right_m - motion.left_m) / (geometry.track_m * (1 + learned.track_scale));
  motion.rotation_rad =
      step.has_gyro
          ? (step.gyro_rad - learned.gyro_bias_rad_s * step.duration_s()) / (1 + learned.gyro_scale)
          : motion.wheel_rotation_rad;
  return motion;
}

}  // namespace cornerd::core
