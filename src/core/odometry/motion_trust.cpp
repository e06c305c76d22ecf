// SPDX-License-Identifier: MIT
#include "core/odometry/motion_trust.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// Of a right sensor's motions: slips, and robots that are carried. Evidence against a sensor is
/// bounded by it: log(0.05) = -3.
constexpr double kOutliers = 0.05;
/// Log odds are kept within this, so that two or three motions show a sensor that breaks.
constexpr double kMostLogOdds = 7;
/// Chi-square, 1 degree of freedom, probability 0.003: a rotation that is less is none.
constexpr double kMotionGate = 9;
/// That a sensor breaks between two fixes. Four scans of slip in a row are as unlikely.
constexpr double kBreaks = 1e-5;
/// Share of the evidence against a sensor that a comparison can give at most: with half of it a
/// stuck gyro is rejected for too long (OdometryFaults.GyroStuck_IsRejected).
constexpr double kSurely = 0.8;
/// Needed to carry a motion that is not small.
constexpr double kTrusted = 0.99;
/// Wheels beside a gyro that is right may slip a few times in a row.
constexpr double kSlipping = 0.02;
/// A wrong sensor is off by as much as the motion: the largest error of a prediction by sensors
/// that are not known to be right.
constexpr double kSmall_m = 0.04;
constexpr double kSmall_rad = radians(3);
/// What a fix may be off by beyond its covariance, as in MotionFilter, and what a scan's motion.
constexpr double kFloor_m = 0.003;
constexpr double kFloor_rad = 0.003;
/// Unevenness of a motion within an increment that a fix divides.
constexpr double kUneven_m_s = 0.07;
constexpr double kUneven_rad_s = 0.2;

double log_odds(double p) { return std::log(p / (1 - p)); }

/// Of a normal distribution, but for a factor; never 0.
double density(double error2, double variance) {
  return std::max(std::exp(-error2 / (2 * variance)) / std::sqrt(variance), 1e-300);
}

}  // namespace

void SensorTrust::add(const MotionError& error) {
  const double wrong = density(error.error2, error.variance + error.motion2);
  const double right = (1 - kOutliers) * density(error.error2, error.variance) + kOutliers * wrong;
  log_odds_ = std::clamp(log_odds_ + std::log(right / wrong), -kMostLogOdds, kMostLogOdds);
}

double SensorTrust::p_right() const { return 1 / (1 + std::exp(-log_odds_)); }

void MotionTrust::add(const OdometryIncrement& step, const MotionFilter& filter) {
  if (step.is_gap) return interrupt();
  const CalibratedIncrement one(step, geometry_, filter.parameters());
  const Eigen::Matrix3d noise = one.covariance(filter.noise(/*slip_share=*/1));
  travel_m_.measured += one.travel_m;
  travel_m_.noise += noise(0, 0);
  wheel_rad_.measured += one.wheel_rotation_rad;
  wheel_rad_.noise += noise(1, 1);
  has_gyro_ = step.has_gyro;
  gyro_rad_.measured += one.rotation_rad;
  gyro_rad_.noise += noise(2, 2);
  may_be_stuck_ = may_be_stuck_ || (step.has_gyro && step.gyro_may_be_stuck);
  longest_s_ = std::max(longest_s_, one.duration_s);
  duration_s_ += one.duration_s;
  travel_since_fix_m_ += std::abs(one.travel_m);
  rotation_since_fix_rad_ += one.rotation_rad;
}

void MotionTrust::compare(Sum& sum, SensorTrust& trust, double end_variance, double calibration,
                          double least) {
  const double motion2 = std::max(squared(sum.measured), squared(sum.seen));
  if (motion2 < squared(least)) return;
  trust.add({squared(sum.measured - sum.seen),
             sum.noise + sum.end_variance + end_variance + calibration * motion2, motion2});
  sum = {.end_variance = end_variance};
}

void MotionTrust::add_comparison(const RotationComparison& rotations) {
  const auto [wheel_rad, gyro_rad, variance] = rotations;
  const double motion2 = std::max(squared(wheel_rad), squared(gyro_rad));
  if (!(variance > 0) || motion2 < kMotionGate * variance) return;
  const double difference2 = squared(wheel_rad - gyro_rad);
  // Densities of the gyro's rotation, given the wheels': where a sensor is off by as much as the
  // motion, or the gyro is reversed, or in degrees.
  constexpr double kFaults = 3;
  const double off = density(difference2, variance + motion2);
  const double reversed = density(squared(wheel_rad + gyro_rad), variance);
  const double in_degrees = radians(1) * density(squared(wheel_rad - radians(gyro_rad)), variance);
  const double wrong = (off + reversed + in_degrees) / kFaults;
  const double right = (1 - kOutliers) * density(difference2, variance) + kOutliers * off;
  const double evidence = std::log(right / wrong);
  agreement_ = std::min(agreement_ + evidence, -log_odds(kBreaks));
  // A rate that repeats to the bit, and surely differs from the wheels', is no slip.
  if (may_be_stuck_ && evidence < kSurely * std::log(kFaults * kOutliers)) agreement_ = 0;
}

void MotionTrust::add_fix(const Pose2& T_map_base, const Covariance3& covariance,
                          const MotionFilter& filter) {
  const double count_m2 = geometry_.quantization_variance();
  const double gyro_rad2 =
      covariance(2, 2) + squared(kFloor_rad) + squared(kUneven_rad_s * longest_s_);
  const double wheel_rad2 = gyro_rad2 + 2 * count_m2 / squared(geometry_.track_m);
  const double travel_m2 = covariance.topLeftCorner<2, 2>().trace() + squared(kFloor_m) +
                           squared(kUneven_m_s * longest_s_) + count_m2 / 2;
  longest_s_ = 0;
  may_be_stuck_ = false;
  travel_since_fix_m_ = rotation_since_fix_rad_ = 0;
  agreement_ = -log_odds(kBreaks);
  if (!has_fix_) {
    travel_m_ = {.end_variance = travel_m2};
    wheel_rad_ = {.end_variance = wheel_rad2};
    gyro_rad_ = {.end_variance = gyro_rad2};
    duration_s_ = 0;
    has_fix_ = true;
    T_map_fix_ = T_map_base;
    return;
  }
  const Pose2 seen = T_map_fix_.inverse() * T_map_base;
  T_map_fix_ = T_map_base;
  travel_m_.seen += std::copysign(seen.translation().norm(), seen.x_m);
  wheel_rad_.seen += seen.theta_rad;
  gyro_rad_.seen += seen.theta_rad;
  const OdometryParameters sigma = filter.sigma();
  const double scale2 = squared(sigma.left_scale) + squared(sigma.right_scale);
  gyro_rad_.noise += squared(sigma.gyro_bias_rad_s * duration_s_);
  duration_s_ = 0;
  compare(travel_m_, travel_, travel_m2, scale2 / 2, kSmall_m);
  compare(wheel_rad_, wheel_rotation_, wheel_rad2, scale2 + squared(sigma.track_scale), kSmall_rad);
  if (has_gyro_) {
    compare(gyro_rad_, gyro_rotation_, gyro_rad2, squared(sigma.gyro_scale), kSmall_rad);
  }
}

bool MotionTrust::uses_gyro() const {
  return gyro_rotation_.p_right() >= 0.5 || wheel_rotation_.p_right() < gyro_rotation_.p_right();
}

double MotionTrust::p_rotation() const {
  return has_gyro_ && uses_gyro() ? gyro_rotation_.p_right() : wheel_rotation_.p_right();
}

bool MotionTrust::is_healthy() const {
  return travel_.p_right() >= 0.5 && p_rotation() >= 0.5 && wheel_rotation_.p_right() >= kSlipping;
}

bool MotionTrust::carries() const {
  return agreement_ > log_odds(kTrusted) &&
         (std::abs(travel_since_fix_m_) < kSmall_m || travel_.p_right() > kTrusted) &&
         (std::abs(rotation_since_fix_rad_) < kSmall_rad || p_rotation() > kTrusted);
}

}  // namespace cornerd::core
