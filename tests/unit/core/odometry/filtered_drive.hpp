// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <Eigen/Cholesky>

#include "core/odometry/motion_filter.hpp"
#include "core/odometry/reading_gate.hpp"
#include "driven_robot.hpp"

namespace cornerd::core::testing {

inline RobotErrors nominal_errors() {
  RobotErrors errors;
  errors.left_scale = 0.015;
  errors.right_scale = 0.025;
  errors.gyro_scale = 0.02;
  errors.gyro_bias_rad_s = 0.01;
  errors.wheel_m_per_sqrt_m = OdometryNoise{}.wheel_m_per_sqrt_m;
  errors.gyro_rad_s_per_sqrt_hz = OdometryNoise{}.gyro_rad_s_per_sqrt_hz;
  return errors;
}

inline constexpr double kFixSigma_m = 0.002;
inline constexpr double kFixSigma_rad = 0.001;

/// A robot, its filter, and a fix of the lidar every 0.14 s.
class FilteredDrive {
 public:
  FilteredDrive(const OdometryConfig& config, const RobotErrors& errors, std::uint64_t seed)
      : robot_(config.geometry, errors, seed), gate_(config), filter_(config) {
    fix_covariance_ = Eigen::Vector3d(kFixSigma_m * kFixSigma_m, kFixSigma_m * kFixSigma_m,
                                      kFixSigma_rad * kFixSigma_rad)
                          .asDiagonal();
    filter_.set_pose(measured(), fix_covariance_, {});
  }

  void drive(double duration_s, bool with_fixes, bool with_gyro = true,
             const std::optional<Rates>& steady = std::nullopt) {
    for (int i = 0; i < std::lround(duration_s * 50); ++i, ++ticks_) {
      const Rates rates = steady.value_or(lively_drive(0.02 * ticks_));
      OdometryReading reading = robot_.drive(0.02, rates.speed_m_s, rates.rate_rad_s);
      if (!with_gyro) reading.gyro_rad_s.reset();
      if (const auto step = gate_.add(reading)) filter_.add(*step);
      if (ticks_ % 7 == 0) filter_.advance();
      // As in Odometer.
      if (with_fixes && ticks_ % 7 == 0 && !correct())
        filter_.set_pose(measured(), fix_covariance_, {});
    }
    filter_.advance();
  }
  bool correct() { return filter_.correct(measured(), fix_covariance_, {}); }

  Pose2 measured() {
    const Pose2& truth = robot_.truth();
    return {truth.x_m + kFixSigma_m * robot_.normal(), truth.y_m + kFixSigma_m * robot_.normal(),
            normalize_angle(truth.theta_rad + kFixSigma_rad * robot_.normal())};
  }
  Eigen::Vector3d error() const {
    const Pose2 pose = filter_.pose();
    const Pose2& truth = robot_.truth();
    return {pose.x_m - truth.x_m, pose.y_m - truth.y_m,
            angle_between(truth.theta_rad, pose.theta_rad)};
  }
  double nees() const {
    return error().dot(Eigen::LLT<Eigen::Matrix3d>(filter_.covariance_at({})).solve(error()));
  }
  MotionFilter& filter() { return filter_; }
  DrivenRobot& robot() { return robot_; }

 private:
  DrivenRobot robot_;
  ReadingGate gate_;
  MotionFilter filter_;
  Covariance3 fix_covariance_;
  int ticks_ = 0;
};

inline OdometryConfig config_with_counts_of_5_mm() {
  OdometryConfig config = switched_on();
  config.geometry.counts_per_turn = 40;
  return config;
}

}  // namespace cornerd::core::testing
