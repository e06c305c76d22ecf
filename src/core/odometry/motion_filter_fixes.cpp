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
/// An innovation within three sigma needs no other reason.
constexpr double kFloorGate = 9;
/// What a fix may be off by that its covariance does not know of: a lidar's bias, a wall that was
/// mapped wrong. The share of it that there is adapts to the innovations.
constexpr double kFixFloor_m = 0.002;
constexpr double kFixFloor_rad = 0.001;
/// Of a random walk over a scan, in units of its variance: what two consecutive fixes that are
/// deskewed by it share: 5/12, by integration over the samples.
constexpr double kSharedNoise = 5.0 / 12;
/// After a detected change: share of the prior's sigma that is added.
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
         jitter_.variance_s2() * velocity * velocity.transpose() +
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
  wheel_rad2_ = gyro_rad2_ = rolled_m_ = 0;
  scans_ = 0;
}

bool MotionFilter::correct(const Pose2& T_map_base, const Covariance3& covariance,
                           const Epoch& epoch) {
  const Pose2 expected = pose_at(epoch);
  const Eigen::Vector3d innovation(T_map_base.x_m - expected.x_m, T_map_base.y_m - expected.y_m,
                                   angle_between(expected.theta_rad, T_map_base.theta_rad));
  const Covariance3 known = covariance_at(epoch) + covariance;
  if (!has_gyro_) {
    slip_rate_.add(
        squared(innovation[2]),
        known(2, 2) + squared(kFixFloor_rad) - kSlipTail * slip_rate_.rad2_per_m() * rolled_m_,
        rolled_m_);
  }
  const Cholesky3 widest(with_floor(known, 1, 1));
  if (!widest.succeeded() || innovation.dot(widest.solve(innovation)) > kFixGate) return false;

  const auto needed = [&](int i, double floor) {
    return (squared(innovation[i]) / kFloorGate - known(i, i)) / squared(floor);
  };
  const double place = std::clamp(std::max(needed(0, kFixFloor_m), needed(1, kFixFloor_m)),
                                  fix_place_.factor(), 1.0);
  const double heading = std::clamp(needed(2, kFixFloor_rad), fix_heading_.factor(), 1.0);
  const Covariance3 innovation_covariance = with_floor(known, place, heading);
  adapt(innovation, known, epoch.is_deskewed);
  const Cholesky3 root(innovation_covariance);
  const Measurement with_state = jacobian_at(epoch) * covariance_;
  detect_changes(with_state, innovation_covariance, innovation);
  const Eigen::Matrix<double, kSize, 3> gain = root.solve_columns(with_state).transpose();
  state_ += gain * innovation;
  covariance_ -= gain * with_state;
  keep_in_bounds();
  wheel_rad2_ = gyro_rad2_ = rolled_m_ = 0;
  scans_ = 0;
  return true;
}

void MotionFilter::adapt(const Eigen::Vector3d& innovation, const Covariance3& known,
                         bool is_deskewed) {
  NoiseEstimator& noise = has_gyro_ ? gyro_noise_ : wheel_noise_;
  const double modelled_rad2 = has_gyro_ ? gyro_rad2_ : wheel_rad2_;
  // The sensors' noise in a scan that is deskewed by them is in the fix as well, and less of it in
  // the innovation of consecutive ones.
  const double of_scan_rad2 = is_deskewed ? modelled_rad2 / std::max(1, scans_) : 0;
  const double heading_rad2 = known(2, 2) + fix_heading_.factor() * squared(kFixFloor_rad);
  noise.add(squared(innovation[2]), modelled_rad2 - kSharedNoise * of_scan_rad2,
            heading_rad2 - noise.factor() * (modelled_rad2 + 2 * kDeskewNoiseShare * of_scan_rad2));
  for (const int i : {0, 1}) {
    fix_place_.add(squared(innovation[i]), squared(kFixFloor_m), known(i, i));
  }
  fix_heading_.add(squared(innovation[2]), squared(kFixFloor_rad), known(2, 2));
}

void MotionFilter::detect_changes(const Measurement& with_state,
                                  const Covariance3& innovation_covariance,
                                  const Eigen::Vector3d& innovation) {
  const Cholesky3 root(innovation_covariance);
  const Eigen::Vector3d whitened = root.whiten(innovation);
  Vector prior = Vector::Zero();
  prior.segment<5>(kBias) << noise_.gyro_bias_rad_s, noise_.wheel_scale, noise_.wheel_scale,
      noise_.track_scale, noise_.gyro_scale;
  prior[kDelay] = noise_.delay_s;
  for (int i = kBias; i < kSize; ++i) {
    const Eigen::Vector3d along = root.whiten(with_state.col(i));
    if (prior[i] == 0 || !(along.squaredNorm() > 0)) continue;
    cusums_[static_cast<std::size_t>(i)].add(along.normalized().dot(whitened));
    if (!cusums_[static_cast<std::size_t>(i)].is_change()) continue;
    cusums_[static_cast<std::size_t>(i)] = {};
    covariance_(i, i) += squared(kChangedShare * prior[i]);
  }
}

}  // namespace cornerd::core
