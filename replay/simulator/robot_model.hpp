// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/odometry_config.hpp"

namespace cornerd::replay {

/// How a simulated robot's wheels and gyro differ from what its config says, and from each other.
struct RobotModel {
  core::DriveGeometry geometry;  ///< as configured
  double rate_hz = 50;           ///< readings a second
  bool has_gyro = true;

  // Relative: 0.02 is 2 % more than configured.
  double left_scale = 0;   ///< of the wheel's radius
  double right_scale = 0;  ///< of the wheel's radius
  double track_scale = 0;
  double gyro_scale = 0;  ///< of the rate that it tells
  double gyro_bias_rad_s = 0;

  double wheel_m_per_sqrt_m = 0.001;       ///< each wheel's way wanders
  double gyro_rad_s_per_sqrt_hz = 0.0002;  ///< an MPU-6050: 0.005 degrees; and the floor shakes it
  double gyro_step_rad_s = 1.0 / 131 * 0.0174533;  ///< its smallest, at 250 degrees a second

  /// Slips: so often a metre one wheel turns on for a fifth of a second by this share more.
  double slips_per_m = 0;
  double slip_share = 0.5;
};

}  // namespace cornerd::replay
