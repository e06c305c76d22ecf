// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/geometry/angle.hpp"

namespace cornerd::core {

/// Geometry of a differential drive.
struct DriveGeometry {
  double wheel_radius_m = 0.0325;
  double track_m = 0.16;                  ///< between the wheels
  double counts_per_turn = 1440;          ///< of a wheel
  std::int64_t counter_max = 0xFFFFFFFF;  ///< highest count, followed by 0; 0: counts never wrap

  double metres_per_count() const { return kTwoPi * wheel_radius_m / counts_per_turn; }
  /// Variance of a wheel's position within a count, m^2: uniform.
  double quantization_variance() const { return metres_per_count() * metres_per_count() / 12; }

  bool operator==(const DriveGeometry&) const = default;
};

/// Physical limits: a reading beyond them is invalid.
struct OdometryLimits {
  double wheel_speed_m_s = 3;
  double gyro_rad_s = 35;  ///< range of common MEMS gyros, 2,000 degrees a second
  /// Largest lead of a reading's time over its arrival; more means a wrong clock. Where the arrival
  /// time is that of the lidar's newest sample, it may be a slow revolution old.
  double ahead_s = 2;

  bool operator==(const OdometryLimits&) const = default;
};

/// Standard deviations of wheels and gyro. Those of scales and bias are priors of
/// OdometryParameters; the first two are initial values that the lidar's fixes correct
/// (NoiseBank).
struct OdometryNoise {
  double wheel_m_per_sqrt_m = 0.0012;  ///< of a wheel's travel after a metre
  double gyro_rad_s_per_sqrt_hz =
      0.00025;  ///< nearly three times a MEMS gyro's data sheet: the robot vibrates
  double wheel_scale = 0.03;
  double track_scale = 0.05;
  double gyro_scale = 0.03;
  double gyro_bias_rad_s = 0.02;
  double delay_s = 0.01;
  /// Random walks of the parameters: tyres wear, a gyro warms up.
  double scale_per_sqrt_s = 2e-5;
  double bias_rad_s_per_sqrt_s = 5e-5;
  double delay_s_per_sqrt_s = 2e-5;

  bool operator==(const OdometryNoise&) const = default;
};

/// Parameters of the robot. A scale is a relative error: a wheel's true travel is (1 + scale) times
/// its counts' travel, the true track (1 + scale) times the configured one, and a gyro reads (1 +
/// scale) times the true rate plus the bias. A reading was true `delay_s` before its time stamp, on
/// the clock of the lidar's samples.
struct OdometryParameters {
  double gyro_bias_rad_s = 0;
  double left_scale = 0;
  double right_scale = 0;
  double track_scale = 0;
  double gyro_scale = 0;
  double delay_s = 0;

  bool operator==(const OdometryParameters&) const = default;
};

struct OdometryConfig {
  bool enabled = false;
  DriveGeometry geometry;
  OdometryLimits limits;
  OdometryNoise noise;
  OdometryParameters initial;       ///< initial estimates
  double max_extrapolation_s = 10;  ///< longest time of dead reckoning without the lidar
  /// Reject predictions after repeated wrong ones, hold back sudden counts, and add uncertainty to
  /// extrapolation. A survey, which adjusts the drive as a whole, switches this off.
  bool conservative = true;
  bool publish_predictions = false;  ///< a predicted pose for every reading

  /// True where what was learned of the robot by the one config holds for the other.
  bool is_of_same_robot(const OdometryConfig& other) const {
    return enabled == other.enabled && geometry == other.geometry && limits == other.limits &&
           noise == other.noise && initial == other.initial && conservative == other.conservative;
  }
};

}  // namespace cornerd::core
