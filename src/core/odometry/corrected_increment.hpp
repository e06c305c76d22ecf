// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {

/// An odometry increment corrected by the robot's parameters.
struct CorrectedIncrement {
  double left_m = 0;
  double right_m = 0;
  double translation_m = 0;
  double wheel_rotation_rad = 0;
  double rotation_rad = 0;  ///< the gyro's, or the wheels' without a gyro
};

inline CorrectedIncrement corrected_increment(const OdometryIncrement& step,
                                              const DriveGeometry& geometry,
                                              const OdometryParameters& learned) {
  CorrectedIncrement motion;
  motion.left_m = step.left_m * (1 + learned.left_scale);
  motion.right_m = step.right_m * (1 + learned.right_scale);
  motion.translation_m = (motion.left_m + motion.right_m) / 2;
  motion.wheel_rotation_rad =
      (motion.right_m - motion.left_m) / (geometry.track_m * (1 + learned.track_scale));
  motion.rotation_rad =
      step.has_gyro
          ? (step.gyro_rad - learned.gyro_bias_rad_s * step.duration_s()) / (1 + learned.gyro_scale)
          : motion.wheel_rotation_rad;
  return motion;
}

}  // namespace cornerd::core
