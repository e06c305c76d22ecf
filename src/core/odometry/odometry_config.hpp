// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/geometry/angle.hpp"

namespace cornerd::core {

/// A robot with two driven wheels, as it was built.
struct DriveGeometry {
  double wheel_radius_m = 0.0325;
  double track_m = 0.16;              ///< between the wheels
  double counts_per_turn = 1440;      ///< of a wheel
  std::int64_t ceiling = 0xFFFFFFFF;  ///< the highest count; 0 follows. 0: counts never wrap

  double metres_per_count() const { return kTwoPi * wheel_radius_m / counts_per_turn; }
  /// Variance of where in its count a wheel stands: any place is as likely as another.
  double rest_m2() const { return metres_per_count() * metres_per_count() / 12; }
};

/// What no robot that needs an A1 does, so that a reading that says so is garbage.
struct OdometryLimits {
  double wheel_speed_m_s = 3;
  double gyro_rad_s = 35;  ///< the range of the usual chips, 2,000 degrees a second
  /// A reading that is farther ahead of the time when it came is one of a wrong clock. Where that
  /// time is the lidar's newest sample, which may be a slow turn old, it is off by more than this.
  double ahead_s = 2;
};

/// How far wheels and gyro may be off, as standard deviations. Those of the scales and of the bias
/// say how well the numbers above are known before the lidar teaches better ones; the first two are
/// a guess that the lidar's fixes correct (NoiseLearning).
struct OdometryNoise {
  double wheel_m_per_sqrt_m = 0.0012;  ///< a wheel's way after a metre: its rolling, its slip
  double gyro_rad_s_per_sqrt_hz =
      0.00025;  ///< nearly three times a MEMS gyro's data sheet: it vibrates
  double wheel_scale = 0.03;
  double track_scale = 0.05;
  double gyro_scale = 0.03;
  double gyro_bias_rad_s = 0.02;
  double delay_s = 0.01;
  /// How the learned ones walk away: tyres wear, a gyro warms up.
  double scale_per_sqrt_s = 2e-5;
  double bias_rad_s_per_sqrt_s = 5e-5;
  double delay_s_per_sqrt_s = 2e-5;
};

/// What is known of the robot itself. A scale is a relative error: the wheel's true way is 1 +
/// scale times what its counts say, the true track 1 + scale times the configured one, and a gyro
/// reads 1 + scale times the true rate, plus the bias. What a reading says was true `delay_s`
/// before the time that it bears, by the clock of the lidar's samples.
struct LearnedOdometry {
  double gyro_bias_rad_s = 0;
  double left_scale = 0;
  double right_scale = 0;
  double track_scale = 0;
  double gyro_scale = 0;
  double delay_s = 0;
};

struct OdometryConfig {
  bool enabled = false;
  DriveGeometry geometry;
  OdometryLimits limits;
  OdometryNoise noise;
  LearnedOdometry start;  ///< what learning starts from
  double bridge_s = 10;   ///< a pose is carried on without the lidar for so long
  /// Turns that were foretold wrong are remembered until others were foretold right, sudden counts
  /// wait for the next, and what is guessed is doubted. A survey, which judges the drive as a
  /// whole, does without.
  bool wary = true;
  bool publish = false;  ///< a pose for every reading, carried on from the last turn
};

}  // namespace cornerd::core
