// SPDX-License-Identifier: MIT
// A simulated robot with exact poses and erroneous sensors.
#pragma once

#include <cstdint>
#include <random>

#include "core/geometry/pose2.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_reading.hpp"

namespace cornerd::core::testing {

/// The defaults' robot.
inline OdometryConfig switched_on() {
  OdometryConfig config;
  config.enabled = true;
  return config;
}

/// As in OdometryParameters, plus noise.
struct RobotErrors {
  double left_scale = 0;
  double right_scale = 0;
  double track_scale = 0;
  double gyro_scale = 0;
  double gyro_bias_rad_s = 0;
  double wheel_m_per_sqrt_m = 0;
  double gyro_rad_s_per_sqrt_hz = 0;
};

class DrivenRobot {
 public:
  DrivenRobot(const DriveGeometry& geometry, const RobotErrors& errors, std::uint64_t seed = 1)
      : geometry_(geometry), errors_(errors), random_(seed) {}

  /// Drives for `dt_s` at this speed with a linear change of the rotation rate. Returns the reading
  /// at the end.
  OdometryReading drive(double dt_s, double speed_m_s, double rate_rad_s);

  /// Another floor, a load, a warm gyro.
  void change(const RobotErrors& errors) { errors_ = errors; }

  const Pose2& truth() const { return T_map_base_; }
  TimeNs now_ns() const { return now_ns_; }
  double normal() { return normal_(random_); }

 private:
  DriveGeometry geometry_;
  RobotErrors errors_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose2 T_map_base_;
  TimeNs now_ns_ = 0;
  double rate_rad_s_ = 0;
  double left_m_ = 0;
  double right_m_ = 0;
};

/// Rotation rates of a varied drive: straights, bends, rotations on the spot, rests.
struct Rates {
  double speed_m_s = 0;
  double rate_rad_s = 0;
};
Rates lively_drive(double t_s);

}  // namespace cornerd::core::testing
