// SPDX-License-Identifier: MIT
#include "core/odometry/fusion_filter.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cornerd::core {
namespace {

/// Wheels and gyro that differ by more than this, squared and in units of what they may, do so
/// because a wheel slips: four sigma.
constexpr double kSlip = 16;
/// Where one wheel slips the other is not quite sure either: this share of the slip's variance.
constexpr double kSlipOfOther = 0.03;
/// Chi-square with three degrees of freedom that one true fix in a million exceeds.
constexpr double kStranger = 30.7;
/// What a robot may do in a time of which nothing is known, a second of it.
constexpr double kUnknown_m_s = 0.5;
constexpr double kUnknown_rad_s = 1.5;
/// Nothing that is built is farther from what it was built to be.
constexpr double kMostScale = 0.5;
constexpr double kMostBias_rad_s = 0.5;
/// A tyre is no line: where it touches the floor wanders with every turn on the spot.
constexpr double kScrub_rad_per_sqrt_rad = 0.001;

/// Two wheels, two ends of a step, and as much again.
constexpr double kCountsForJitter = 8;

/// A gyro that says more than this, squared and in units of what it may say at rest, while no count
/// comes: the robot turns by less than a count.
constexpr double kCreeps = 9;

constexpr double squared(double value) { return value * value; }

}  // namespace

FusionFilter::FusionFilter(const OdometryConfig& config)
    : geometry_(config.geometry), noise_(config.noise), learning_(config.geometry) {
  state_[kBias] = config.start.gyro_bias_rad_s;
  state_[kLeft] = config.start.left_scale;
  state_[kRight] = config.start.right_scale;
  state_[kTrack] = config.start.track_scale;
  state_[kGyro] = config.start.gyro_scale;
  covariance_(kBias, kBias) = squared(noise_.gyro_bias_rad_s);
  covariance_(kLeft, kLeft) = squared(noise_.wheel_scale);
  covariance_(kRight, kRight) = squared(noise_.wheel_scale);
  covariance_(kTrack, kTrack) = squared(noise_.track_scale);
  covariance_(kGyro, kGyro) = squared(noise_.gyro_scale);
  covariance_(kLeftRest, kLeftRest) = covariance_(kRightRest, kRightRest) = geometry_.rest_m2();
}

FusionFilter::Wheels FusionFilter::wheels(const MotionStep& step) const {
  Wheels wheels;
  wheels.left_m = step.left_m * (1 + state_[kLeft]);
  wheels.right_m = step.right_m * (1 + state_[kRight]);
  wheels.way_m = (wheels.left_m + wheels.right_m) / 2;
  wheels.turn_rad = (wheels.right_m - wheels.left_m) / (geometry_.track_m * (1 + state_[kTrack]));
  return wheels;
}

Pose2 FusionFilter::motion_of(const MotionStep& step) const {
  const Wheels moved = wheels(step);
  const double turn_rad =
      step.has_gyro ? (step.gyro_rad - state_[kBias] * step.duration_s()) / (1 + state_[kGyro])
                    : moved.turn_rad;
  return arc(moved.way_m, turn_rad);
}

void FusionFilter::predict(const MotionStep& step) {
  if (step.is_hole) return predict_hole(step);
  const double dt_s = step.duration_s();
  const double bias_rad = state_[kBias] * dt_s;
  const double gyro_told_rad2 = squared(noise_.gyro_rad_s_per_sqrt_hz) * dt_s;
  // When within the step the rate changed nobody knows: evenly between its two ends.
  // Readings that come late or early count a rate for too long or too short; the wheels' counts do
  // not mind. Unreckoned with, it looks like slip, and what is made of that drives the scales away.
  const double rate_rad_s = dt_s > 0 ? step.gyro_rad / dt_s : 0;
  const double rest_m2 = geometry_.rest_m2();
  const double track_m = geometry_.track_m * (1 + state_[kTrack]);
  // Counts change sides with every reading as well, by so much.
  const double counts_rad2 = kCountsForJitter * rest_m2 / squared(track_m);
  const double jitter_rad2 =
      std::max(0.0, 2 * jitter_.variance_s2() * squared(rate_rad_s) - counts_rad2);
  const double gyro_rad2 =
      gyro_told_rad2 * learning_.gyro_factor() + squared(step.gyro_change_rad) / 3 + jitter_rad2;
  const bool creeps =
      step.has_gyro && squared(step.gyro_rad - bias_rad) >
                           kCreeps * (gyro_rad2 + covariance_(kBias, kBias) * squared(dt_s));
  const bool rolls = step.left_m != 0 || step.right_m != 0 || creeps;

  // A count stands for a stretch, and where in it a wheel has come to is new with every step: what
  // one step leaves out the next one has too much, however many there are.
  Wheels moved = wheels(step);
  const double wheel_factor = learning_.wheel_factor();
  const double wheel_m = squared(noise_.wheel_m_per_sqrt_m) * wheel_factor;
  const double scrub_rad = squared(kScrub_rad_per_sqrt_rad) * wheel_factor;
  double left_m2 = wheel_m * std::abs(moved.left_m);
  double right_m2 = wheel_m * std::abs(moved.right_m);
  double turn_rad2 = (left_m2 + right_m2) / squared(track_m) + scrub_rad * std::abs(moved.turn_rad);
  const double told_rad2 = turn_rad2 / wheel_factor;
  double old_rests_rad2 = 0;
  if (rolls) {
    left_m2 += rest_m2;
    right_m2 += rest_m2;
    turn_rad2 += 2 * rest_m2 / squared(track_m);
    moved.way_m -= (state_[kLeftRest] + state_[kRightRest]) / 2;
    moved.turn_rad -= (state_[kRightRest] - state_[kLeftRest]) / track_m;
    old_rests_rad2 = (covariance_(kLeftRest, kLeftRest) + covariance_(kRightRest, kRightRest) -
                      2 * covariance_(kLeftRest, kRightRest)) /
                     squared(track_m);
  }

  // What the gyro says beyond the wheels, and how much that may be.
  const double gyro_gain = 1 + state_[kGyro];
  Row turn_by = turn_slope(moved.way_m, moved.turn_rad, rolls);
  Row seen_by = seen_slope(turn_by, moved.turn_rad, dt_s);
  Row usual_by = seen_by;
  double surprise_rad = step.gyro_rad - gyro_gain * moved.turn_rad - bias_rad;
  double known_rad2 = variance_along(seen_by) + gyro_rad2;
  // The way is taken in the direction half-way through the wheels' turn, and follows it as the gyro
  // corrects it; a slip is too large for that, and the way is taken at what the gyro leaves of it.
  double course_rad = state_[kTheta] + moved.turn_rad / 2;
  double follows = 1;
  bool slips = false;
  if (step.has_gyro && dt_s > 0) {
    const double expected_rad2 = known_rad2 + squared(gyro_gain) * turn_rad2;
    jitter_.add(surprise_rad, rate_rad_s, expected_rad2 - jitter_rad2);
    slips = squared(surprise_rad) > kSlip * expected_rad2;
    const double turns_rad = std::max(std::abs(moved.turn_rad), std::abs(step.gyro_rad - bias_rad));
    slip_watch_.add(squared(turns_rad) > kSlip * expected_rad2, slips, dt_s);
    if (slips) {
      // One of the wheels did not do what its counts say, most likely the one that says more; the
      // gyro does not slip. With that wheel in doubt, the gyro tells its way as well.
      ++slips_;
      const double slip_m2 = squared(surprise_rad / gyro_gain * track_m);
      (std::abs(moved.left_m) > std::abs(moved.right_m) ? left_m2 : right_m2) += slip_m2;
      left_m2 += kSlipOfOther * slip_m2;
      right_m2 += kSlipOfOther * slip_m2;
      turn_rad2 += (1 + 2 * kSlipOfOther) * slip_m2 / squared(track_m);
    }
    // What the scales do to the turn is taken at what wheels and gyro together say, and what they
    // do to the surprise at the motion of the steps before: with a step's own noise in the slope as
    // well as in the surprise the scales are biased (by 1 % in
    // tests/unit/core/odometry/fusion_filter_test.cpp, and without end on a circle).
    const double both_rad = moved.turn_rad + gyro_gain * (turn_rad2 + old_rests_rad2) /
                                                 (known_rad2 + squared(gyro_gain) * turn_rad2) *
                                                 surprise_rad;
    if (slips) {
      course_rad = state_[kTheta] + both_rad / 2;
      follows = 0;
    }
    turn_by = turn_slope(moved.way_m, both_rad, rolls);
    const Motion itself{moved.way_m, both_rad, dt_s};
    const Motion before = usual_.of(itself);
    usual_by = seen_slope(turn_slope(before.way_m, before.turn_rad, rolls), before.turn_rad, dt_s);
    seen_by = seen_slope(turn_by, both_rad, dt_s);
    known_rad2 = variance_along(seen_by) + gyro_rad2;
    usual_.add(itself);
  }
  learning_.drove(step, told_rad2, gyro_told_rad2, slips);
  Row way_by = Row::Zero();
  way_by[kLeft] = step.left_m / 2;
  way_by[kRight] = step.right_m / 2;
  if (rolls) way_by[kLeftRest] = way_by[kRightRest] = -0.5;

  // The pose moves on: F and G of its three rows.
  const double c = std::cos(course_rad);
  const double s = std::sin(course_rad);
  Eigen::Matrix<double, 3, kSize> transition = Eigen::Matrix<double, 3, kSize>::Identity();
  transition(kX, kTheta) = -moved.way_m * s;
  transition(kY, kTheta) = moved.way_m * c;
  const double aside_m = follows * moved.way_m / 2;
  transition.row(kX) += c * way_by - aside_m * s * turn_by;
  transition.row(kY) += s * way_by + aside_m * c * turn_by;
  transition.row(kTheta) += turn_by;

  const Eigen::Vector3d by_way(c, s, 0);
  const Eigen::Vector3d by_turn(-aside_m * s, aside_m * c, 1);
  const double way_m2 = (left_m2 + right_m2) / 4;
  const double way_turn = (right_m2 - left_m2) / (2 * track_m);

  // The covariance of the state moved on with what the gyro sees: the wheels' noise is in both.
  const auto moved_on = [&](const Row& slope) {
    Vector with = covariance_ * slope.transpose();
    with.head<3>() = (transition * with).eval();
    with.head<3>() += gyro_gain * (by_way * way_turn + by_turn * turn_rad2);
    return with;
  };
  Vector with_seen = moved_on(seen_by);
  Vector with_usual = moved_on(usual_by);
  const double noise_rad2 = gyro_rad2 + squared(gyro_gain) * turn_rad2;
  const double seen_rad2 = variance_along(seen_by) + noise_rad2;
  const double usual_rad2 = variance_along(usual_by) + noise_rad2;

  const Eigen::Matrix<double, 3, kSize> with_pose = transition * covariance_;
  const Covariance3 noise =
      by_way * by_way.transpose() * way_m2 + by_turn * by_turn.transpose() * turn_rad2 +
      (by_way * by_turn.transpose() + by_turn * by_way.transpose()) * way_turn;
  covariance_.topRows<3>() = with_pose;
  covariance_.leftCols<3>() = with_pose.transpose();
  covariance_.topLeftCorner<3, 3>() = with_pose * transition.transpose() + noise;
  if (rolls) {
    Eigen::Matrix<double, kSize, 2> with_rests = Eigen::Matrix<double, kSize, 2>::Zero();
    with_rests.topRows<3>() << by_way / 2 - by_turn / track_m, by_way / 2 + by_turn / track_m;
    with_rests.bottomRows<2>().setIdentity();
    with_rests *= rest_m2;
    covariance_.rightCols<2>() = with_rests;
    covariance_.bottomRows<2>() = with_rests.transpose();
    const double seen_m2 = gyro_gain / track_m * rest_m2;
    with_seen.tail<2>() << -seen_m2, seen_m2;
    with_usual.tail<2>() = with_seen.tail<2>();
  }
  covariance_(kBias, kBias) += squared(noise_.bias_rad_s_per_sqrt_s) * dt_s;
  for (const int scale : {kLeft, kRight, kTrack, kGyro}) {
    covariance_(scale, scale) += squared(noise_.scale_per_sqrt_s) * dt_s;
  }
  state_[kX] += moved.way_m * c;
  state_[kY] += moved.way_m * s;
  state_[kTheta] += moved.turn_rad;
  if (rolls) state_[kLeftRest] = state_[kRightRest] = 0;

  if (step.has_gyro && usual_rad2 > 0) {
    // Not quite the best gain: the covariance is that of any.
    const Vector gain = with_usual / usual_rad2;
    state_ += gain * surprise_rad;
    const Matrix known = gain * with_seen.transpose();
    covariance_ += seen_rad2 * gain * gain.transpose() - known - known.transpose();
  }
  keep_in_bounds();
}

FusionFilter::Row FusionFilter::turn_slope(double way_m, double turn_rad, bool rolls) const {
  const double track_m = geometry_.track_m * (1 + state_[kTrack]);
  Row slope = Row::Zero();
  slope[kLeft] = -(way_m - turn_rad * track_m / 2) / (track_m * (1 + state_[kLeft]));
  slope[kRight] = (way_m + turn_rad * track_m / 2) / (track_m * (1 + state_[kRight]));
  slope[kTrack] = -turn_rad / (1 + state_[kTrack]);
  if (rolls) {
    slope[kLeftRest] = 1 / track_m;
    slope[kRightRest] = -1 / track_m;
  }
  return slope;
}

FusionFilter::Row FusionFilter::seen_slope(const Row& turn_by, double turn_rad, double dt_s) const {
  Row slope = (1 + state_[kGyro]) * turn_by;
  slope[kBias] += dt_s;
  slope[kGyro] += turn_rad;
  return slope;
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
    wander.turn_rad2 =
        squared(noise_.gyro_rad_s_per_sqrt_hz) * learning_.gyro_factor() * duration_s;
  } else {
    wander.turn_rad2 +=
        squared(kScrub_rad_per_sqrt_rad) * learning_.wheel_factor() * std::abs(way.theta_rad);
  }
  if (duration_s > 0) {
    const double late_share2 = jitter_.variance_s2() / squared(duration_s);
    wander.place_m2 += late_share2 * squared(way_m);
    wander.turn_rad2 += late_share2 * squared(way.theta_rad);
  }
  return wander;
}

double FusionFilter::variance_along(const Row& slope) const {
  return (slope * covariance_ * slope.transpose()).value();
}

void FusionFilter::predict_hole(const MotionStep& step) {
  learning_.interrupt();
  usual_.forget();
  const double dt_s = step.duration_s();
  const double moved_m2 = squared(kUnknown_m_s * dt_s);
  covariance_(kX, kX) += moved_m2;
  covariance_(kY, kY) += moved_m2;
  covariance_(kTheta, kTheta) += squared(std::min(kUnknown_rad_s * dt_s, kPi));
}

void FusionFilter::set_pose(const Pose2& T_map_base, const Covariance3& covariance) {
  state_.head<3>() << T_map_base.x_m, T_map_base.y_m, T_map_base.theta_rad;
  covariance_.topRows<3>().setZero();
  covariance_.leftCols<3>().setZero();
  covariance_.topLeftCorner<3, 3>() = covariance;
  learning_.interrupt();
}

Eigen::Vector3d FusionFilter::surprise_of(const Pose2& T_map_base) const {
  return {T_map_base.x_m - state_[kX], T_map_base.y_m - state_[kY],
          angle_between(state_[kTheta], T_map_base.theta_rad)};
}

bool FusionFilter::explains(const Pose2& T_map_base, const Covariance3& covariance) const {
  const Eigen::Vector3d surprise = surprise_of(T_map_base);
  const Eigen::LLT<Eigen::Matrix3d> root(pose_covariance() + covariance);
  return root.info() == Eigen::Success && surprise.dot(root.solve(surprise)) < kStranger;
}

bool FusionFilter::correct(const Pose2& T_map_base, const Covariance3& covariance) {
  if (!explains(T_map_base, covariance)) return false;
  learning_.fixed(T_map_base.theta_rad, covariance(2, 2), learned(),
                  covariance_.block<5, 5>(kBias, kBias));
  const Eigen::Vector3d surprise = surprise_of(T_map_base);
  const Eigen::LLT<Eigen::Matrix3d> root(pose_covariance() + covariance);
  const Eigen::Matrix<double, kSize, 3> with_pose = covariance_.leftCols<3>();
  const Eigen::Matrix<double, kSize, 3> gain = root.solve(with_pose.transpose()).transpose();
  state_ += gain * surprise;
  covariance_ -= gain * with_pose.transpose();
  keep_in_bounds();
  return true;
}

LearnedOdometry FusionFilter::learned() const {
  return {state_[kBias], state_[kLeft], state_[kRight], state_[kTrack], state_[kGyro]};
}

void FusionFilter::keep_in_bounds() {
  state_[kTheta] = normalize_angle(state_[kTheta]);
  state_[kBias] = std::clamp(state_[kBias], -kMostBias_rad_s, kMostBias_rad_s);
  for (const int scale : {kLeft, kRight, kTrack, kGyro}) {
    state_[scale] = std::clamp(state_[scale], -kMostScale, kMostScale);
  }
  // What rounding makes of a symmetric matrix is symmetric to the last bits alone.
  covariance_ = ((covariance_ + covariance_.transpose()) / 2).eval();
  for (int i = 0; i < kSize; ++i) covariance_(i, i) = std::max(covariance_(i, i), 1e-14);
}

}  // namespace cornerd::core
