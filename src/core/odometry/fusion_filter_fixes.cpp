// SPDX-License-Identifier: MIT
// What the lidar's fixes teach the filter, and what it says of itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/geometry/linear_solve.hpp"
#include "core/geometry/squared.hpp"
#include "core/odometry/corrected_increment.hpp"
#include "core/odometry/fusion_filter.hpp"

namespace cornerd::core {
namespace {

/// Chi-square with three degrees of freedom that one true fix in a million exceeds.
constexpr double kStranger = 30.7;
/// Nothing that is built is farther from what it was built to be.
constexpr double kMostScale = 0.5;
constexpr double kMostBias_rad_s = 0.5;
constexpr double kMaxDelay_s = 0.2;
/// What changed in a drive is doubted by this share of what it was at first; where that is not
/// enough, again. A delay by less: with much doubt it takes for its own what scales do, and by a
/// clock that drifts by 100 ppm poses were off by 3 degrees.
constexpr double kDoubtedAnew = 0.3;
constexpr double kDelayDoubtedAnew = 0.1;

}  // namespace

Pose2 FusionFilter::motion_of(const OdometryIncrement& step) const {
  const CorrectedIncrement motion = corrected_increment(step, geometry_, learned());
  return arc(motion.translation_m, motion.rotation_rad);
}

FusionFilter::Wander FusionFilter::wander_of(const Pose2& way, double duration_s,
                                             bool has_gyro) const {
  const double track_m = geometry_.track_m * (1 + state_[kTrack]);
  const double way_m = way.translation().norm();
  const double aside_m = std::abs(way.theta_rad) * track_m / 2;
  const double rolled_m = std::abs(way_m - aside_m) + way_m + aside_m;  // by both wheels
  const double wheel_m2 = squared(noise_.wheel_m_per_sqrt_m) * learning_.wheel_factor() * rolled_m;
  Wander wander{wheel_m2 / 4, wheel_m2 / squared(track_m)};
  if (has_gyro) {
    wander.rotation_variance =
        squared(noise_.gyro_rad_s_per_sqrt_hz) * learning_.gyro_factor() * duration_s;
  } else {
    wander.rotation_variance +=
        squared(kScrub_rad_per_sqrt_rad) * learning_.wheel_factor() * std::abs(way.theta_rad);
  }
  if (duration_s > 0) {
    const double late_share2 = jitter_.variance_s2() / squared(duration_s);
    wander.place_m2 += late_share2 * squared(way_m);
    wander.rotation_variance += late_share2 * squared(way.theta_rad);
  }
  return wander;
}

void FusionFilter::set_velocity(double speed_m_s, double rate_rad_s) {
  speed_m_s_ = speed_m_s;
  rate_rad_s_ = rate_rad_s;
}

void FusionFilter::doubt_times() { covariance_(kDelay, kDelay) += squared(noise_.delay_s); }

Eigen::Vector3d FusionFilter::velocity() const {
  return {speed_m_s_ * std::cos(state_[kTheta]), speed_m_s_ * std::sin(state_[kTheta]),
          rate_rad_s_};
}

Eigen::Matrix<double, 3, FusionFilter::kSize> FusionFilter::seen_with_state() const {
  return covariance_.topRows<3>() + velocity() * covariance_.row(kDelay);
}

Covariance3 FusionFilter::pose_covariance(double more_delay_s2) const {
  const Eigen::Matrix<double, 3, kSize> with = seen_with_state();
  Covariance3 covariance = with.leftCols<3>() + with.col(kDelay) * velocity().transpose() +
                           jitter_.variance_s2() * velocity() * velocity().transpose();
  if (more_delay_s2 > 0 && covariance_(kDelay, kDelay) > 0) {
    const Eigen::Vector3d by_delay = with.col(kDelay) / covariance_(kDelay, kDelay);
    covariance += more_delay_s2 * by_delay * by_delay.transpose();
  }
  return covariance;
}

void FusionFilter::set_pose(const Pose2& T_map_base, const Covariance3& covariance) {
  state_.head<3>() << T_map_base.x_m, T_map_base.y_m, T_map_base.theta_rad;
  covariance_.topRows<3>().setZero();
  covariance_.leftCols<3>().setZero();
  // The place at the reading's time is the one that was seen, less the way of what the delay is
  // off.
  const Eigen::Matrix<double, 3, kSize> with_state = -velocity() * covariance_.row(kDelay);
  covariance_.topRows<3>() = with_state;
  covariance_.leftCols<3>() = with_state.transpose();
  covariance_.topLeftCorner<3, 3>() =
      covariance + covariance_(kDelay, kDelay) * velocity() * velocity().transpose();
  learning_.interrupt();
  since_fix_ = {.start = T_map_base.translation()};
}

Eigen::Vector3d FusionFilter::surprise_of(const Pose2& T_map_base) const {
  return {T_map_base.x_m - state_[kX], T_map_base.y_m - state_[kY],
          angle_between(state_[kTheta], T_map_base.theta_rad)};
}

bool FusionFilter::explains(const Pose2& T_map_base, const Covariance3& covariance) const {
  const Eigen::Vector3d surprise = surprise_of(T_map_base);
  const Cholesky3 root(pose_covariance() + covariance);
  return root.succeeded() && surprise.dot(root.solve(surprise)) < kStranger;
}

bool FusionFilter::correct(const Pose2& T_map_base, const Covariance3& covariance) {
  if (!explains(T_map_base, covariance)) return false;
  learning_.fixed(T_map_base.theta_rad, covariance(2, 2), learned(),
                  covariance_.block<5, 5>(kBias, kBias));
  const Eigen::Vector3d surprise = surprise_of(T_map_base);
  const Cholesky3 root(pose_covariance() + covariance);
  watch_pulls(root, surprise);
  const Eigen::Matrix<double, 3, kSize> with_state = seen_with_state();
  const Eigen::Matrix<double, kSize, 3> gain = root.solve_columns(with_state).transpose();
  state_ += gain * surprise;
  covariance_ -= gain * with_state;
  keep_in_bounds();
  since_fix_ = {.start = T_map_base.translation()};
  return true;
}

void FusionFilter::watch_pulls(const Cholesky3& root, const Eigen::Vector3d& surprise) {
  const Eigen::Vector3d whitened = root.whiten(surprise);
  const std::array doubted_anew = {std::pair(kBias, kDoubtedAnew * noise_.gyro_bias_rad_s),
                                   std::pair(kLeft, kDoubtedAnew * noise_.wheel_scale),
                                   std::pair(kRight, kDoubtedAnew * noise_.wheel_scale),
                                   std::pair(kTrack, kDoubtedAnew * noise_.track_scale),
                                   std::pair(kGyro, kDoubtedAnew * noise_.gyro_scale),
                                   std::pair(kDelay, kDelayDoubtedAnew * noise_.delay_s)};
  const Eigen::Matrix<double, 3, kSize> with_state = seen_with_state();
  for (const auto& [index, sigma] : doubted_anew) {
    const Eigen::Vector3d seen = root.whiten(with_state.col(index));
    if (!(seen.squaredNorm() > 0)) continue;
    pulls_[index].add(seen.normalized().dot(whitened));
    if (!pulls_[index].is_one_sided()) continue;
    pulls_[index] = {};
    covariance_(index, index) += squared(sigma);
  }
}

OdometryParameters FusionFilter::learned() const {
  return {state_[kBias],  state_[kLeft], state_[kRight],
          state_[kTrack], state_[kGyro], state_[kDelay]};
}

void FusionFilter::keep_in_bounds() {
  state_[kTheta] = normalize_angle(state_[kTheta]);
  state_[kBias] = std::clamp(state_[kBias], -kMostBias_rad_s, kMostBias_rad_s);
  state_[kDelay] = std::clamp(state_[kDelay], -kMaxDelay_s, kMaxDelay_s);
  for (const int scale : {kLeft, kRight, kTrack, kGyro}) {
    state_[scale] = std::clamp(state_[scale], -kMostScale, kMostScale);
  }
  // What rounding makes of a symmetric matrix is symmetric to the last bits alone.
  covariance_ = ((covariance_ + covariance_.transpose()) / 2).eval();
  for (int i = 0; i < kDelay; ++i) covariance_(i, i) = std::max(covariance_(i, i), 1e-14);
  covariance_(kDelay, kDelay) = std::max(covariance_(kDelay, kDelay), 0.0);
}

}  // namespace cornerd::core
