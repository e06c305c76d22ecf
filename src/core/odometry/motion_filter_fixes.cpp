// SPDX-License-Identifier: MIT
// The measurement update: fixes of the lidar.
#include <algorithm>
#include <cmath>

#include "core/geometry/linear_solve.hpp"
#include "core/geometry/squared.hpp"
#include "core/odometry/motion_filter.hpp"

namespace cornerd::core {
namespace {

/// Chi-square, 3 degrees of freedom, probability 1e-6.
constexpr double kFixGate = 30.7;
/// What a fix may be off by that its covariance does not know of: a lidar's bias, a wall that was
/// mapped wrong. The share of it that there is adapts to the innovations.
constexpr double kFixFloor_m = 0.002;
constexpr double kFixFloor_rad = 0.001;
/// A parameter changes where the cumulative sum of the innovations along it, normalised, exceeds so
/// many sigma (Page 1954), with forgetting (Lucas and Saccucci 1990): of thirty fixes. Constant
/// parameters reach 3.1 in drives of 600 fixes, wheels that change by 1 % 25.
constexpr double kForgetting = 0.97;
constexpr double kChange = 5;
/// After a change: share of the prior's sigma that is added.
constexpr double kChangedShare = 0.3;

Covariance3 with_floor(const Covariance3& covariance, double place, double heading) {
  const Eigen::Vector3d floor(place * squared(kFixFloor_m), place * squared(kFixFloor_m),
                              heading * squared(kFixFloor_rad));
  return covariance + Covariance3(floor.asDiagonal());
}

}  // namespace

Pose2 MotionFilter::pose_at(const Epoch& epoch) const {
  return pose() * epoch.velocity.over(epoch.lead_s);
}

Eigen::Vector3d MotionFilter::velocity_in_map(const Epoch& epoch) const {
  const Twist2& v = epoch.velocity;
  return rotation_of(pose_at(epoch).theta_rad) * Eigen::Vector3d(v.vx_m_s, v.vy_m_s, v.omega_rad_s);
}

MotionFilter::Measurement MotionFilter::jacobian_at(const Epoch& epoch) const {
  Measurement jacobian = Measurement::Identity();
  const Vec2 lever = pose_at(epoch).translation() - pose().translation();
  jacobian(kX, kTheta) = -lever.y();
  jacobian(kY, kTheta) = lever.x();
  jacobian.col(kDelay) = velocity_in_map(epoch);
  return jacobian;
}

Covariance3 MotionFilter::covariance_at(const Epoch& epoch) const {
  const Measurement jacobian = jacobian_at(epoch);
  const Eigen::Vector3d velocity = jacobian.col(kDelay);
  const Eigen::Vector3d guess(kUnknown_m_s, kUnknown_m_s, kUnknown_rad_s);
  // At any time of the lead, evenly.
  const double guessed_s2 = squared(std::max(0.0, epoch.lead_s)) / 3;
  return jacobian * covariance_ * jacobian.transpose() +
         jitter_s2() * velocity * velocity.transpose() +
         Covariance3((guessed_s2 * guess.cwiseAbs2()).asDiagonal());
}

void MotionFilter::set_pose(const Pose2& T_map_base, const Covariance3& covariance,
                            const Epoch& epoch) {
  const Pose2 now = T_map_base * epoch.velocity.over(epoch.lead_s).inverse();
  state_.head<3>() << now.x_m, now.y_m, now.theta_rad;
  const Eigen::Vector3d velocity = velocity_in_map(epoch);
  const Eigen::Matrix<double, 3, kSize> with_state = -velocity * covariance_.row(kDelay);
  covariance_.topRows<3>() = with_state;
  covariance_.leftCols<3>() = with_state.transpose();
  covariance_.topLeftCorner<3, 3>() =
      covariance + covariance_(kDelay, kDelay) * velocity * velocity.transpose();
  seen_slip_rate_ = slip_rate_;
  heading_noise().restart(fix_beside_sensor(covariance(2, 2), epoch.is_deskewed));
  begin_walk();
}

void MotionFilter::begin_walk() {
  fixed_rad2_ = covariance_(kTheta, kTheta);
  wheel_rad2_ = gyro_rad2_ = rolled_m_ = by_wheels_rad_ = 0;
  scans_ = 0;
}

bool MotionFilter::correct(const Pose2& T_map_base, const Covariance3& covariance,
                           const Epoch& epoch) {
  const Pose2 expected = pose_at(epoch);
  const Eigen::Vector3d innovation(T_map_base.x_m - expected.x_m, T_map_base.y_m - expected.y_m,
                                   angle_between(expected.theta_rad, T_map_base.theta_rad));
  const Covariance3 known = covariance_at(epoch) + covariance;
  Covariance3 without_slips = known;
  without_slips(2, 2) -= slip_rad2(rolled_m_);
  const bool is_slip =
      !has_gyro_ &&
      slip_rate_.add(squared(innovation[2]),
                     without_slips(2, 2) + heading_noise().floor() * squared(kFixFloor_rad),
                     rolled_m_);
  const Cholesky3 widest(with_floor(known, 1, 1));
  const bool agrees = widest.succeeded() && innovation.dot(widest.solve(innovation)) <= kFixGate;
  if (has_gyro_ && agrees) slip_rate_ = seen_slip_rate_;
  seen_slip_rate_ = slip_rate_;
  if (!agrees) return false;

  const Cholesky3 root(with_floor(known, fix_place_.factor(), heading_noise().floor()));
  // With the jitter of the times and what is extrapolated.
  const double measured_rad2 = known(2, 2) - covariance_(kTheta, kTheta);
  WalkStep step = fix_beside_sensor(std::max(covariance(2, 2), measured_rad2), epoch.is_deskewed);
  const double delay_before_s = state_[kDelay];
  const Measurement with_innovation = jacobian_at(epoch) * covariance_;
  detect_changes(with_innovation, root, innovation);
  update<3>(innovation, root.solve_columns(with_innovation).transpose(),
            with_innovation.transpose());
  keep_in_bounds();
  step.innovation = by_wheels_rad_ + innovation[2];
  step.correction = by_wheels_rad_ + angle_between(expected.theta_rad, pose_at(epoch).theta_rad) +
                    epoch.velocity.omega_rad_s * (state_[kDelay] - delay_before_s);
  if (is_slip) {
    heading_noise().restart(step);
  } else {
    heading_noise().add(step);
    for (const int i : {0, 1}) {
      fix_place_.add(squared(innovation[i]), squared(kFixFloor_m), known(i, i));
    }
  }
  begin_walk();
  return true;
}

WalkStep MotionFilter::fix_beside_sensor(double fix_rad2, bool is_deskewed) const {
  const double factor = heading_noise().factor();
  const double walk_rad2 = has_gyro_ ? gyro_rad2_ : wheel_rad2_;
  const double scan_rad2 = is_deskewed ? walk_rad2 / std::max(1, scans_) : 0;
  const double grown_rad2 = covariance_(kTheta, kTheta) - fixed_rad2_ - slip_rad2(rolled_m_);
  return {.walk = walk_rad2,
          .other = std::max(0.0, grown_rad2 - factor * walk_rad2),
          .averaged = scan_rad2,
          .noise = std::max(0.0, fix_rad2 - kDeskewNoiseShare * factor * scan_rad2),
          .floor = squared(kFixFloor_rad)};
}

void MotionFilter::detect_changes(const Measurement& with_innovation, const Cholesky3& root,
                                  const Eigen::Vector3d& innovation) {
  const Eigen::Vector3d whitened = root.whiten(innovation);
  for (const int i : {kBias, kLeft, kRight, kTrack, kGyro, kDelay}) {
    const Eigen::Vector3d along = root.whiten(with_innovation.col(i));
    if (!(along.squaredNorm() > 0)) continue;
    cusums_[i] = kForgetting * cusums_[i] + along.normalized().dot(whitened);
    cusum_variances_[i] = squared(kForgetting) * cusum_variances_[i] + 1;
    if (squared(cusums_[i]) <= squared(kChange) * cusum_variances_[i]) continue;
    cusums_[i] = cusum_variances_[i] = 0;
    covariance_(i, i) += squared(kChangedShare * prior_sigma_[i]);
  }
}

}  // namespace cornerd::core
