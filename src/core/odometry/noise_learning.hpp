// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "core/odometry/noise_meter.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {

/// How much wheels and gyro really wander: their turn from one fix of the lidar to a later one is
/// compared with that of the fixes, as long as slips, holes or a lost place do not come between.
class NoiseLearning {
 public:
  /// Of the learned ones, in the order of OdometryParameters's members.
  using Covariance = Eigen::Matrix<double, 5, 5>;

  explicit NoiseLearning(const DriveGeometry& geometry) : geometry_(geometry) {}

  /// `wheel_rad2`, `gyro_rad2`: variance of the turn by each as it was told.
  void drove(const OdometryIncrement& step, double wheel_rad2, double gyro_rad2, bool slips);
  /// The lidar's heading, its variance, and what was known of the robot just before it.
  void fixed(double heading_rad, double variance_rad2, const OdometryParameters& learned,
             const Covariance& covariance);
  /// The next fix has nothing to do with the last one.
  void interrupt();

  /// Variance of the wheels' way, as a multiple of what was told; of the gyro's turn.
  double wheel_factor() const { return wheel_factor_.factor(); }
  double gyro_factor() const { return gyro_factor_.factor(); }

 private:
  /// Since a fix.
  struct Window {
    bool is_open = false;
    double heading_rad = 0;
    double variance_rad2 = 0;
    OdometryParameters learned;
    Covariance covariance = Covariance::Zero();
    int fixes = 0;
    double left_m = 0;
    double right_m = 0;
    double gyro_rad = 0;
    double duration_s = 0;
    double told_rad2 = 0;
  };
  using Slope = Eigen::RowVector<double, 5>;

  void close_wheels(double heading_rad, double variance_rad2);
  void close_gyro(double heading_rad, double variance_rad2);

  DriveGeometry geometry_;
  Window by_wheels_;
  Window by_gyro_;
  NoiseMeter wheel_factor_{8, 0.1, 25};
  NoiseMeter gyro_factor_{4, 0.3, 25};
};

}  // namespace cornerd::core
