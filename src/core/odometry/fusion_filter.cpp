// SPDX-License-Identifier: MIT
// How a step of wheels and gyro moves the filter.
#include "core/odometry/fusion_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"
#include "core/odometry/corrected_increment.hpp"
#include "core/odometry/fusion_prediction.hpp"

namespace cornerd::core {
namespace {

/// What a robot may do in a time of which nothing is known, a second of it.
constexpr double kUnknown_m_s = 0.5;
constexpr double kUnknown_rad_s = 1.5;

/// A gyro that says more than this, squared and in units of what it may say at rest, while no count
/// comes: the robot turns by less than a count.
constexpr double kCreeps = 9;

}  // namespace

FusionFilter::FusionFilter(const OdometryConfig& config)
    : geometry_(config.geometry), noise_(config.noise), learning_(config.geometry) {
  start_from(config.initial);
}

void FusionFilter::start_from(const OdometryParameters& start) {
  pulls_ = {};
  state_.setZero();
  state_[kBias] = start.gyro_bias_rad_s;
  state_[kLeft] = start.left_scale;
  state_[kRight] = start.right_scale;
  state_[kTrack] = start.track_scale;
  state_[kGyro] = start.gyro_scale;
  state_[kDelay] = start.delay_s;
  covariance_.setZero();
  covariance_(kBias, kBias) = squared(noise_.gyro_bias_rad_s);
  covariance_(kLeft, kLeft) = squared(noise_.wheel_scale);
  covariance_(kRight, kRight) = squared(noise_.wheel_scale);
  covariance_(kTrack, kTrack) = squared(noise_.track_scale);
  covariance_(kGyro, kGyro) = squared(noise_.gyro_scale);
  covariance_(kDelay, kDelay) = squared(noise_.delay_s);
  covariance_(kLeftRest, kLeftRest) = covariance_(kRightRest, kRightRest) =
      geometry_.quantization_variance();
  learning_ = NoiseLearning(geometry_);
  usual_.forget();
}

void FusionFilter::predict(const OdometryIncrement& step) {
  if (step.is_gap) return predict_hole(step);
  Prediction p = by_wheels(step);
  if (step.has_gyro && p.dt_s > 0) {
    compare_with_gyro(p);
  } else {
    slip_watch_.add_single(p.dt_s);
  }
  learning_.drove(step, p.told_rad2, p.gyro_told_rad2, p.slips);
  move_on(p);
}

FusionFilter::Prediction FusionFilter::by_wheels(const OdometryIncrement& step) const {
  Prediction p{.step = step};
  p.dt_s = step.duration_s();
  p.track_m = geometry_.track_m * (1 + state_[kTrack]);
  p.gyro_gain = 1 + state_[kGyro];
  p.bias_rad = state_[kBias] * p.dt_s;
  expect_of_gyro(p);
  const bool creeps =
      step.has_gyro && squared(step.gyro_rad - p.bias_rad) >
                           kCreeps * (p.gyro_rad2 + covariance_(kBias, kBias) * squared(p.dt_s));
  p.rolls = step.left_m != 0 || step.right_m != 0 || creeps;

  // A count stands for a stretch, and where in it a wheel has come to is new with every step: what
  // one step leaves out the next one has too much, however many there are.
  p.moved = corrected_increment(step, geometry_, learned());
  const double quantization_variance = geometry_.quantization_variance();
  const double wheel_factor = learning_.wheel_factor();
  const double wheel_m = squared(noise_.wheel_m_per_sqrt_m) * wheel_factor;
  const double scrub_rad = squared(kScrub_rad_per_sqrt_rad) * wheel_factor;
  p.left_m2 = wheel_m * std::abs(p.moved.left_m);
  p.right_m2 = wheel_m * std::abs(p.moved.right_m);
  p.rotation_variance = (p.left_m2 + p.right_m2) / squared(p.track_m) +
                        scrub_rad * std::abs(p.moved.wheel_rotation_rad);
  p.told_rad2 = p.rotation_variance / wheel_factor;
  if (p.rolls) {
    p.left_m2 += quantization_variance;
    p.right_m2 += quantization_variance;
    p.rotation_variance += 2 * quantization_variance / squared(p.track_m);
    p.moved.translation_m -= (state_[kLeftRest] + state_[kRightRest]) / 2;
    p.moved.wheel_rotation_rad -= (state_[kRightRest] - state_[kLeftRest]) / p.track_m;
    p.old_rests_rad2 = (covariance_(kLeftRest, kLeftRest) + covariance_(kRightRest, kRightRest) -
                        2 * covariance_(kLeftRest, kRightRest)) /
                       squared(p.track_m);
  }
  p.turn_by = turn_slope(p.moved.translation_m, p.moved.wheel_rotation_rad, p.rolls);
  p.usual_by = p.seen_by = seen_slope(p.turn_by, p.moved.wheel_rotation_rad, p.dt_s);
  p.surprise_rad = step.gyro_rad - p.gyro_gain * p.moved.wheel_rotation_rad - p.bias_rad;
  p.course_rad = state_[kTheta] + p.moved.wheel_rotation_rad / 2;
  return p;
}

void FusionFilter::move_on(const Prediction& p) {
  const OdometryIncrement& step = p.step;
  Row way_by = Row::Zero();
  way_by[kLeft] = step.left_m / 2;
  way_by[kRight] = step.right_m / 2;
  if (p.rolls) way_by[kLeftRest] = way_by[kRightRest] = -0.5;

  // The pose moves on: F and G of its three rows.
  const double c = std::cos(p.course_rad);
  const double s = std::sin(p.course_rad);
  Eigen::Matrix<double, 3, kSize> transition = Eigen::Matrix<double, 3, kSize>::Identity();
  transition(kX, kTheta) = -p.moved.translation_m * s;
  transition(kY, kTheta) = p.moved.translation_m * c;
  const double aside_m = p.follows * p.moved.translation_m / 2;
  transition.row(kX) += c * way_by - aside_m * s * p.turn_by;
  transition.row(kY) += s * way_by + aside_m * c * p.turn_by;
  transition.row(kTheta) += p.turn_by;

  const Eigen::Vector3d by_way(c, s, 0);
  const Eigen::Vector3d by_turn(-aside_m * s, aside_m * c, 1);
  const double way_m2 = (p.left_m2 + p.right_m2) / 4;
  const double way_turn = (p.right_m2 - p.left_m2) / (2 * p.track_m);

  // The covariance of the state moved on with what the gyro sees: the wheels' noise is in both.
  const auto moved_on = [&](const Row& slope) {
    Vector with = covariance_ * slope.transpose();
    with.head<3>() = (transition * with).eval();
    with.head<3>() += p.gyro_gain * (by_way * way_turn + by_turn * p.rotation_variance);
    return with;
  };
  Vector with_seen = moved_on(p.seen_by);
  Vector with_usual = moved_on(p.usual_by);
  const double noise_rad2 = p.gyro_rad2 + squared(p.gyro_gain) * p.rotation_variance;
  const double seen_rad2 = variance_along(p.seen_by) + noise_rad2;
  const double usual_rad2 = variance_along(p.usual_by) + noise_rad2;

  const Eigen::Matrix<double, 3, kSize> with_pose = transition * covariance_;
  const Covariance3 noise =
      by_way * by_way.transpose() * way_m2 + by_turn * by_turn.transpose() * p.rotation_variance +
      (by_way * by_turn.transpose() + by_turn * by_way.transpose()) * way_turn;
  covariance_.topRows<3>() = with_pose;
  covariance_.leftCols<3>() = with_pose.transpose();
  covariance_.topLeftCorner<3, 3>() = with_pose * transition.transpose() + noise;
  if (p.rolls) {
    const double quantization_variance = geometry_.quantization_variance();
    Eigen::Matrix<double, kSize, 2> with_rests = Eigen::Matrix<double, kSize, 2>::Zero();
    with_rests.topRows<3>() << by_way / 2 - by_turn / p.track_m, by_way / 2 + by_turn / p.track_m;
    with_rests.middleRows<2>(kLeftRest).setIdentity();
    with_rests *= quantization_variance;
    covariance_.middleCols<2>(kLeftRest) = with_rests;
    covariance_.middleRows<2>(kLeftRest) = with_rests.transpose();
    const double seen_m2 = p.gyro_gain / p.track_m * quantization_variance;
    with_seen.segment<2>(kLeftRest) << -seen_m2, seen_m2;
    with_usual.segment<2>(kLeftRest) = with_seen.segment<2>(kLeftRest);
  }
  covariance_(kBias, kBias) += squared(noise_.bias_rad_s_per_sqrt_s) * p.dt_s;
  covariance_(kDelay, kDelay) += squared(noise_.delay_s_per_sqrt_s) * p.dt_s;
  for (const int scale : {kLeft, kRight, kTrack, kGyro}) {
    covariance_(scale, scale) += squared(noise_.scale_per_sqrt_s) * p.dt_s;
  }
  state_[kX] += p.moved.translation_m * c;
  state_[kY] += p.moved.translation_m * s;
  state_[kTheta] += p.moved.wheel_rotation_rad;
  since_fix_.rolled_m += (std::abs(p.moved.left_m) + std::abs(p.moved.right_m)) / 2;
  since_fix_.rotated_rad += std::abs(p.moved.wheel_rotation_rad);
  since_fix_.duration_s += p.dt_s;
  if (p.rolls) state_[kLeftRest] = state_[kRightRest] = 0;

  if (step.has_gyro && usual_rad2 > 0) {
    // Not quite the best gain: the covariance is that of any.
    const Vector gain = with_usual / usual_rad2;
    state_ += gain * p.surprise_rad;
    const Matrix known = gain * with_seen.transpose();
    covariance_ += seen_rad2 * gain * gain.transpose() - known - known.transpose();
  }
  keep_in_bounds();
}

FusionFilter::Row FusionFilter::turn_slope(double way_m, double rotation_rad, bool rolls) const {
  const double track_m = geometry_.track_m * (1 + state_[kTrack]);
  Row slope = Row::Zero();
  slope[kLeft] = -(way_m - rotation_rad * track_m / 2) / (track_m * (1 + state_[kLeft]));
  slope[kRight] = (way_m + rotation_rad * track_m / 2) / (track_m * (1 + state_[kRight]));
  slope[kTrack] = -rotation_rad / (1 + state_[kTrack]);
  if (rolls) {
    slope[kLeftRest] = 1 / track_m;
    slope[kRightRest] = -1 / track_m;
  }
  return slope;
}

double FusionFilter::variance_along(const Row& slope) const {
  return (slope * covariance_ * slope.transpose()).value();
}

void FusionFilter::predict_hole(const OdometryIncrement& step) {
  learning_.interrupt();
  usual_.forget();
  doubt_times();
  const double dt_s = step.duration_s();
  const double moved_m2 = squared(kUnknown_m_s * dt_s);
  covariance_(kX, kX) += moved_m2;
  covariance_(kY, kY) += moved_m2;
  covariance_(kTheta, kTheta) += squared(std::min(kUnknown_rad_s * dt_s, kPi));
}

}  // namespace cornerd::core
