// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_reading.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::replay {

/// A simulated robot: its configured geometry, and the errors of wheels and gyro.
struct RobotModel {
  core::DriveGeometry geometry;  ///< as configured
  double rate_hz = 50;           ///< readings per second
  bool has_gyro = true;

  // Relative: 0.02 is 2 % more than configured.
  double left_scale = 0;   ///< of the wheel's radius
  double right_scale = 0;  ///< of the wheel's radius
  double track_scale = 0;
  double gyro_scale = 0;  ///< of the measured rate
  double gyro_bias_rad_s = 0;

  double wheel_m_per_sqrt_m = 0.001;               ///< random walk of each wheel's travel
  double gyro_rad_s_per_sqrt_hz = 0.0002;          ///< MPU-6050: 0.005 deg/s, plus vibration
  double gyro_step_rad_s = 1.0 / 131 * 0.0174533;  ///< resolution at 250 deg/s full scale

  /// Slips: during 0.2 s one wheel rotates by `slip_share` more than it travels.
  double slips_per_m = 0;
  double slip_share = 0.5;
};

/// Encoder and gyro readings of a simulated drive. Deterministic for model, drive and seed.
class SimulatedOdometry {
 public:
  /// Throws std::invalid_argument if the rate is not in [1, 1000] Hz.
  SimulatedOdometry(Motion motion, const RobotModel& model, std::uint64_t seed);

  core::TimeNs next_ns() const { return next_ns_; }
  core::OdometryReading next();

 private:
  void advance(core::TimeNs to_ns);
  double wheel_travel(double distance_m, double radius_scale);

  Motion motion_;
  RobotModel model_;
  Random random_;
  core::TimeNs period_ns_;
  core::TimeNs next_ns_ = 0;
  core::TimeNs now_ns_ = 0;
  core::Pose2 T_map_base_;
  double left_m_ = 0;  ///< by the configured radius
  double right_m_ = 0;
  double rate_rad_s_ = 0;
  double until_slip_m_ = 0;
  core::TimeNs slips_until_ns_ = 0;
  bool left_slips_ = false;
};

}  // namespace cornerd::replay
