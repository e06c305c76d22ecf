// SPDX-License-Identifier: MIT
#include "core/odometry/motion_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// Chi-square, 1 degree of freedom, probability 1e-4.
constexpr double kSlipGate = 15.1;
/// Correlation of a slip with the travel of the wheel that turned more: that wheel with 97 %.
constexpr double kLikelier = 0.94;
/// Where a tyre touches the floor changes with every rotation on the spot: 0.14 degrees after a
/// revolution.
constexpr double kScrub_rad_per_sqrt_rad = 0.001;
/// Bounds of the calibration; of scales in sigma of their priors: more is a wrong setting, doubled
/// counts (-50 %) among them. A survey, which nobody drives by, corrects a radius that is a third
/// too small (SurveyCommandTest.WrongWheelRadius).
constexpr double kMostSigmas = 10;
constexpr double kMostSigmasOfSurvey = 15;
constexpr double kMostBias_rad_s = 0.5;
constexpr double kMostDelay_s = 0.2;

}  // namespace

MotionFilter::MotionFilter(const OdometryConfig& config)
    : geometry_(config.geometry),
      noise_(config.noise),
      most_sigmas_(config.conservative ? kMostSigmas : kMostSigmasOfSurvey),
      factor_(config.geometry, config.initial),
      // Fixes in a growing map share errors: what they show seems smaller than it is.
      wheel_noise_(config.conservative ? 0.1 : 1, 100, config.conservative ? 0.03 : 1),
      gyro_noise_(config.conservative ? 0.1 : 1, 100, config.conservative ? 0.03 : 1),
      fix_place_(config.conservative ? 0.03 : 1, 1) {
  const OdometryParameters& initial = config.initial;
  state_.segment<5>(kBias) << initial.gyro_bias_rad_s, initial.left_scale, initial.right_scale,
      initial.track_scale, initial.gyro_scale;
  state_[kDelay] = initial.delay_s;
  prior_sigma_.segment<5>(kBias) << noise_.gyro_bias_rad_s, noise_.wheel_scale, noise_.wheel_scale,
      noise_.track_scale, noise_.gyro_scale;
  prior_sigma_.segment<2>(kLeftRest).setConstant(std::sqrt(geometry_.quantization_variance()));
  prior_sigma_[kDelay] = noise_.delay_s;
  covariance_.diagonal() = prior_sigma_.cwiseAbs2();
  factor_ = factor();
}

Eigen::Matrix3d MotionFilter::rotation_of(double theta_rad) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation(0, 0) = rotation(1, 1) = std::cos(theta_rad);
  rotation(1, 0) = std::sin(theta_rad);
  rotation(0, 1) = -rotation(1, 0);
  return rotation;
}

MotionNoise MotionFilter::noise(double slip_share) const {
  const double wheel = wheel_noise_.factor();
  return {.wheel_m2_per_m = wheel * squared(noise_.wheel_m_per_sqrt_m),
          .scrub_rad2_per_rad = wheel * squared(kScrub_rad_per_sqrt_rad),
          .slip_rad2_per_m = slip_share / kSlipTail * slip_rad2(1),
          .gyro_rad2_per_s = gyro_noise_.factor() * squared(noise_.gyro_rad_s_per_sqrt_hz)};
}

void MotionFilter::add(const OdometryIncrement& step) {
  if (step.has_gyro != has_gyro_ || step.is_gap) advance();
  if (step.is_gap) return predict_gap(step.duration_s());
  if (factor_.duration_s() == 0) {
    if (step.has_gyro != has_gyro_) switch_heading_sensor();
    factor_ = factor();  // by the parameters of now
  }
  jitter_s2_ = step.jitter_s2;
  factor_.add(step);
}

void MotionFilter::switch_heading_sensor() {
  const WalkNoiseEstimator& before = heading_noise();
  has_gyro_ = !has_gyro_;
  heading_noise().take_floor(before);
  wheel_noise_.interrupt();
  gyro_noise_.interrupt();
  uncounted_ = {};
}

void MotionFilter::advance() {
  const double dt_s = factor_.duration_s();
  if (!(dt_s > 0)) return;
  const Pose2 motion = factor_.motion();
  const Eigen::Vector3d moved(motion.x_m, motion.y_m, factor_.rotation_rad());
  MotionFactor::Jacobian by = factor_.jacobian();
  const MotionFactor::EndSlope by_end = factor_.end_slope();
  const double rest_m2 = geometry_.quantization_variance();
  // Of the times of both ends.
  const double jitter_rad2 = 2 * jitter_s2() * squared(factor_.rotation_rad() / dt_s);
  if (!factor_.is_counted()) {
    // There is no rotation that a scale could have scaled, but noise.
    by(2, MotionFactor::kGyro) = by(3, MotionFactor::kTrack) = 0;
  } else if (has_gyro_) {
    // Slopes by the scales at the rotation that both measure: at each one's own they would be
    // correlated with its noise, and the scales biased (errors in variables).
    const double gyro_rad2 = factor_.covariance()(2, 2) + jitter_rad2;
    const double wheel_rad2 = factor_.covariance()(3, 3) + 4 * rest_m2 / squared(geometry_.track_m);
    const double rotation_rad =
        (wheel_rad2 * factor_.rotation_rad() + gyro_rad2 * factor_.wheel_rotation_rad()) /
        (wheel_rad2 + gyro_rad2);
    by(2, MotionFactor::kGyro) = -rotation_rad / (1 + state_[kGyro]);
    by(3, MotionFactor::kTrack) = -rotation_rad / (1 + state_[kTrack]);
  }
  const MotionFactor::Column of_rests = by.rightCols<2>() * state_.segment<2>(kLeftRest);

  // The state, and below it the wheels' rotation less the gyro's, by the state before and by the
  // noise: of the factor, and of the wheels' positions within their counts.
  constexpr int kDifference = kSize;
  const Eigen::Matrix3d rotation = rotation_of(state_[kTheta]);
  const Eigen::Vector3d displacement = rotation * (moved + of_rests.head<3>());
  Eigen::Matrix<double, kSize + 1, kSize> by_state = decltype(by_state)::Identity();
  by_state(kX, kTheta) = -displacement.y();
  by_state(kY, kTheta) = displacement.x();
  by_state.block<3, 7>(kX, kBias) = rotation * by.topRows<3>();
  by_state.diagonal().segment<2>(kLeftRest).setZero();
  by_state.block<1, 7>(kDifference, kBias) = by.row(3) - by.row(2);
  Eigen::Matrix<double, kSize + 1, 6> by_noise = decltype(by_noise)::Zero();
  by_noise.topLeftCorner<3, 3>() = rotation;
  by_noise.topRightCorner<3, 2>() = rotation * by_end.topRows<3>();
  by_noise.block<2, 2>(kLeftRest, 4).setIdentity();
  by_noise.row(kDifference) << 0, 0, -1, 1, by_end.row(3) - by_end.row(2);
  Eigen::Matrix<double, 6, 6> noise = decltype(noise)::Zero();
  noise.topLeftCorner<4, 4>() = factor_.covariance();
  noise.diagonal().tail<2>().setConstant(rest_m2);
  const Eigen::Matrix<double, kSize + 1, kSize + 1> joint =
      by_state * covariance_ * by_state.transpose() + by_noise * noise * by_noise.transpose();

  state_.head<3>() += displacement;
  state_.segment<2>(kLeftRest).setZero();
  covariance_ = joint.topLeftCorner<kSize, kSize>();
  Vector walk = Vector::Zero();
  walk.segment<5>(kBias).setConstant(noise_.scale_per_sqrt_s);
  walk[kBias] = noise_.bias_rad_s_per_sqrt_s;
  walk[kDelay] = noise_.delay_s_per_sqrt_s;
  covariance_.diagonal() += dt_s * walk.cwiseAbs2();

  wheel_rad2_ += (noise(3, 3) - slip_rad2(factor_.rolled_m())) / wheel_noise_.factor();
  gyro_rad2_ += squared(noise_.gyro_rad_s_per_sqrt_hz) * dt_s;
  rolled_m_ += has_gyro_ ? 0 : factor_.rolled_m();
  ++scans_;
  if (has_gyro_) {
    compare_rotations(
        factor_.wheel_rotation_rad() - factor_.rotation_rad() + of_rests[3] - of_rests[2],
        joint(kDifference, kDifference), jitter_rad2, joint.col(kDifference).head<kSize>());
  }
  keep_in_bounds();
  factor_ = factor();
}

void MotionFilter::compare_rotations(double difference_rad, double variance, double jitter_rad2,
                                     Vector with_difference) {
  const double difference_rad2 = squared(difference_rad);
  if (!(variance + jitter_rad2 > 0)) return;
  const WalkStep step = wheels_beside_gyro(variance, jitter_rad2);
  const bool is_counted = factor_.is_counted();
  variance += jitter_rad2;
  rotations_ = {factor_.rotation_rad() + difference_rad, factor_.rotation_rad(), variance};
  if (is_counted) {
    seen_slip_rate_.add(difference_rad2, variance, factor_.rolled_m());
  }
  double robust_variance = variance;
  if (difference_rad2 > kSlipGate * variance) {
    // The travel of one wheel is wrong by as much, most likely of the one that turned more: the
    // difference measures the mean travel as well.
    ++slips_;
    const bool is_right = factor_.motion().x_m * factor_.wheel_rotation_rad() > 0;
    const Vec2 slip_m = std::abs(difference_rad) * geometry_.track_m / 2 *
                        unit_vector(state_[kTheta] - factor_.rotation_rad() / 2);
    covariance_.topLeftCorner<2, 2>() += slip_m * slip_m.transpose();
    with_difference.head<2>() +=
        kLikelier * (is_right ? 1 : -1) * std::abs(difference_rad) * slip_m;
    robust_variance += difference_rad2;
    wheel_noise_.restart(step);
  } else if (is_counted) {
    wheel_noise_.add(step);
  }
  uncounted_ = is_counted ? WalkStep{} : step;
  const double before_rad = state_[kTheta];
  const double before_rad2 = covariance_(kTheta, kTheta);
  update<1>(-Eigen::Matrix<double, 1, 1>(difference_rad), with_difference / robust_variance,
            with_difference);
  by_wheels_rad_ += state_[kTheta] - before_rad;
  fixed_rad2_ += covariance_(kTheta, kTheta) - before_rad2;
}

WalkStep MotionFilter::wheels_beside_gyro(double variance, double jitter_rad2) const {
  const double wheel_rad2 = factor_.covariance()(3, 3);
  const double ends_rad2 = 4 * geometry_.quantization_variance() / squared(geometry_.track_m);
  const double difference_rad =
      uncounted_.innovation + factor_.wheel_rotation_rad() - factor_.rotation_rad();
  // The sum follows the wheels: the innovation is the correction. The floor is of one end, where
  // both wheels are within their counts.
  return {.innovation = difference_rad,
          .correction = difference_rad,
          .walk = wheel_rad2 / wheel_noise_.factor(),
          .other = uncounted_.other + std::max(0.0, variance - wheel_rad2 - ends_rad2),
          .noise = jitter_rad2 / 2,
          .floor = ends_rad2 / 2};
}

void MotionFilter::predict_gap(double duration_s) {
  doubt_times();
  wheel_noise_.interrupt();
  uncounted_ = {};
  const double place_m2 = squared(kUnknown_m_s * duration_s);
  covariance_.diagonal().head<3>() +=
      Eigen::Vector3d(place_m2, place_m2, squared(std::min(kUnknown_rad_s * duration_s, kPi)));
}

void MotionFilter::doubt_times() { covariance_(kDelay, kDelay) += squared(noise_.delay_s); }

OdometryParameters MotionFilter::parameters() const {
  return {state_[kBias],  state_[kLeft], state_[kRight],
          state_[kTrack], state_[kGyro], state_[kDelay]};
}

OdometryParameters MotionFilter::sigma() const {
  const Vector sigma = covariance_.diagonal().cwiseSqrt();
  return {sigma[kBias], sigma[kLeft], sigma[kRight], sigma[kTrack], sigma[kGyro], sigma[kDelay]};
}

bool MotionFilter::is_in_bounds() const {
  return state_.segment<2>(kLeft).cwiseAbs().maxCoeff() < most_sigmas_ * noise_.wheel_scale;
}

void MotionFilter::keep_in_bounds() {
  state_[kTheta] = normalize_angle(state_[kTheta]);
  state_[kBias] = std::clamp(state_[kBias], -kMostBias_rad_s, kMostBias_rad_s);
  state_[kDelay] = std::clamp(state_[kDelay], -kMostDelay_s, kMostDelay_s);
  const Eigen::Vector4d most = most_sigmas_ * prior_sigma_.segment<4>(kLeft);
  state_.segment<4>(kLeft) = state_.segment<4>(kLeft).cwiseMax(-most).cwiseMin(most);
  // Rounding leaves a symmetric matrix symmetric to the last bits alone.
  covariance_ = ((covariance_ + covariance_.transpose()) / 2).eval();
  covariance_.diagonal().head<kDelay>() = covariance_.diagonal().head<kDelay>().cwiseMax(1e-14);
  covariance_(kDelay, kDelay) = std::max(covariance_(kDelay, kDelay), 0.0);
}

}  // namespace cornerd::core
