// SPDX-License-Identifier: MIT
#include "core/odometry/motion_factor.hpp"

#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {

CalibratedIncrement::CalibratedIncrement(const OdometryIncrement& step,
                                         const DriveGeometry& geometry,
                                         const OdometryParameters& by)
    : duration_s(step.duration_s()),
      track_m(geometry.track_m * (1 + by.track_scale)),
      gyro_gain(1 + by.gyro_scale),
      left_m((1 + by.left_scale) * step.left_m),
      right_m((1 + by.right_scale) * step.right_m),
      travel_m((left_m + right_m) / 2),
      wheel_rotation_rad((right_m - left_m) / track_m),
      rotation_rad(step.has_gyro ? (step.gyro_rad - by.gyro_bias_rad_s * duration_s) / gyro_gain
                                 : wheel_rotation_rad),
      gyro_change_rad(step.gyro_change_rad),
      has_gyro(step.has_gyro) {}

double CalibratedIncrement::rolled_m() const { return (std::abs(left_m) + std::abs(right_m)) / 2; }

Eigen::Matrix3d CalibratedIncrement::covariance(const MotionNoise& noise) const {
  const double left_m2 = noise.wheel_m2_per_m * std::abs(left_m);
  const double right_m2 = noise.wheel_m2_per_m * std::abs(right_m);
  const double slip_rad2 = noise.slip_rad2_per_m * rolled_m();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance(0, 0) = (left_m2 + right_m2) / 4 + slip_rad2 * squared(track_m / 2);
  covariance(0, 1) = covariance(1, 0) = (right_m2 - left_m2) / (2 * track_m);
  covariance(1, 1) = (left_m2 + right_m2) / squared(track_m) +
                     noise.scrub_rad2_per_rad * std::abs(wheel_rotation_rad) + slip_rad2;
  if (has_gyro) {
    // When within the step the rate changed is unknown: evenly between its two ends.
    covariance(2, 2) =
        (noise.gyro_rad2_per_s * duration_s + squared(gyro_change_rad) / 3) / squared(gyro_gain);
  } else {
    covariance.row(2) = covariance.row(1);
    covariance.col(2) = covariance.col(1);
  }
  return covariance;
}

void MotionFactor::add(const OdometryIncrement& step) {
  const CalibratedIncrement one(step, geometry_, at_);
  const double dt_s = one.duration_s;
  const bool is_first = duration_s_ == 0;
  const double way_m = one.travel_m;
  const double wheel_rad = one.wheel_rotation_rad;
  const double turn_rad = one.rotation_rad;

  // How travel s, wheels' rotation f and rotation w of this step change with the parameters.
  Eigen::Matrix<double, 3, kParameters> by = Eigen::Matrix<double, 3, kParameters>::Zero();
  by(0, kLeft) = step.left_m / 2;
  by(0, kRight) = step.right_m / 2;
  by(1, kLeft) = -step.left_m / track_m_;
  by(1, kRight) = step.right_m / track_m_;
  by(1, kTrack) = -wheel_rad / (1 + at_.track_scale);
  if (is_first) {
    by(0, kLeftRest) = by(0, kRightRest) = -0.5;
    by(1, kLeftRest) = 1 / track_m_;
    by(1, kRightRest) = -1 / track_m_;
  }
  if (step.has_gyro) {
    by(2, kBias) = -dt_s / one.gyro_gain;
    by(2, kGyro) = -turn_rad / one.gyro_gain;
  } else {
    by.row(2) = by.row(1);
  }

  // The motion before moves on (transition), and the step is added to it (slope by s, f, w).
  const double course_rad = p_[2] + turn_rad / 2;
  const double c = std::cos(course_rad);
  const double s = std::sin(course_rad);
  Covariance transition = Covariance::Identity();
  transition(0, 2) = -way_m * s;
  transition(1, 2) = way_m * c;
  Eigen::Matrix<double, kRows, 3> slope;
  slope << c, 0, -way_m * s / 2,  //
      s, 0, way_m * c / 2,        //
      0, 0, 1,                    //
      0, 1, 0;
  jacobian_ = transition * jacobian_ + slope * by;
  covariance_ = transition * covariance_ * transition.transpose() +
                slope * one.covariance(noise_) * slope.transpose();
  p_ += Column(way_m * c, way_m * s, turn_rad, wheel_rad);

  duration_s_ += dt_s;
  rolled_m_ += one.rolled_m();
  has_gyro_ = has_gyro_ && step.has_gyro;
  is_counted_ = is_counted_ || step.left_m != 0 || step.right_m != 0;
  ends_by_gyro_ = step.has_gyro;
  if (!(dt_s > 0)) return;
  last_ = {way_m / dt_s, turn_rad / dt_s, wheel_rad / dt_s};
  if (is_first) first_ = last_;
}

MotionFactor::EndSlope MotionFactor::end_slope() const {
  const double c = std::cos(p_[2]) / 2;
  const double s = std::sin(p_[2]) / 2;
  const double turn = 1 / track_m_;
  const double heading = ends_by_gyro_ ? 0 : turn;
  EndSlope slope;
  slope << c, c, s, s, -heading, heading, -turn, turn;
  return slope;
}

MotionFactor::Column MotionFactor::delay_slope() const {
  const double c = std::cos(p_[2]);
  const double s = std::sin(p_[2]);
  return {last_.speed_m_s * c - first_.speed_m_s + first_.rate_rad_s * p_[1],
          last_.speed_m_s * s - first_.rate_rad_s * p_[0], last_.rate_rad_s - first_.rate_rad_s,
          last_.wheel_rate_rad_s - first_.wheel_rate_rad_s};
}

}  // namespace cornerd::core
