// SPDX-License-Identifier: MIT
// What odometry foretells, and what the lidar's fixes make of it.
#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"
#include "core/odometry/odometer.hpp"

namespace cornerd::core {
namespace {

/// A prediction that is less sure than this helps nobody to find the place again.
constexpr double kMostSigma_m = 0.3;
constexpr double kMostSigma_rad = radians(15);
/// What a fix may be off by that its covariance does not know of, a lidar's bias or a wall that was
/// mapped wrong, until the fixes themselves tell how much it is; a fix that belongs to the same
/// drive may be off by so much at any time.
constexpr double kFixFloor_m = 0.002;
constexpr double kFixFloor_rad = 0.001;
/// A surprise within three sigma needs no other reason.
constexpr double kUsual = 9;
/// A delay that the filter need not find out by itself may be so much larger than it is told.
constexpr double kUsualDelay = 2;
/// What the filter may have to find out by itself is no more than this.
constexpr double kUnknownDelay_s = 0.02;
/// Readings that are missing for longer than this may have had something to tell.
constexpr TimeNs kPause_ns = 40'000'000;

/// `place`, `heading`: shares of the floors' variances.
Covariance3 with_floor(const Covariance3& covariance, double place, double heading) {
  Covariance3 sum = covariance;
  sum(0, 0) += place * kFixFloor_m * kFixFloor_m;
  sum(1, 1) += place * kFixFloor_m * kFixFloor_m;
  sum(2, 2) += heading * kFixFloor_rad * kFixFloor_rad;
  return sum;
}

/// A wrong turn anywhere on the way since the last fix, and `place_m2` beside it.
Covariance3 doubt_of_turn(const FusionFilter& filter, double rotation_variance, double place_m2) {
  const double aside_m2 = place_m2 + rotation_variance * squared(filter.way_since_fix_m()) / 3;
  return Eigen::Vector3d(aside_m2, aside_m2, rotation_variance).asDiagonal();
}

}  // namespace

Covariance3 Odometer::doubt_of_change(double unread_s2) {
  const Eigen::Vector3d change(kChange_m_s, kChange_m_s, kChange_rad_s);
  return (unread_s2 * change.cwiseAbs2()).asDiagonal();
}

Covariance3 Odometer::doubt_of_guess(TimeNs guessed_ns) {
  const double guessed_s = to_seconds(guessed_ns);
  return doubt_of_change(guessed_s * guessed_s);
}

Covariance3 Odometer::doubt_of_slips(const FusionFilter& filter) const {
  if (!doubts_slips()) return Covariance3::Zero();
  const double rotation_variance = turn_slips_.rad2_per_m() * filter.since_fix().rolled_m;
  return doubt_of_turn(filter, rotation_variance,
                       rotation_variance * squared(config_.geometry.track_m / 2));
}

void Odometer::watch_for_slips(const Pose2& T_map_base, const Covariance3& covariance) {
  if (!has_pose_ || !doubts_slips()) return;
  turn_slips_.add(squared(filter_.surprise_of(T_map_base)[2]),
                  filter_.pose_covariance()(2, 2) + covariance(2, 2) + squared(kFixFloor_rad),
                  filter_.since_fix().rolled_m);
}

std::optional<PredictedPose> Odometer::prediction() const {
  return prediction_of(filter_, middle_ns_, guessed_ns());
}

std::optional<PredictedPose> Odometer::prediction_of(const FusionFilter& filter, TimeNs t_ns,
                                                     TimeNs guessed_ns) const {
  if (!has_pose_ || !present_ || !is_believed() || filter.is_contradictory()) return std::nullopt;
  if (to_seconds(t_ns - fixed_ns_) > config_.max_extrapolation_s) return std::nullopt;
  if (config_.conservative &&
      !fix_watch_.carries(filter.way_since_fix_m(), filter.since_fix().rotated_rad)) {
    return std::nullopt;
  }
  const double more_s2 = delay_doubt_s2(filter.learned().delay_s);
  Covariance3 covariance = filter.pose_covariance(more_s2);
  covariance += doubt_of_change(more_s2) + doubt_of_guess(guessed_ns);
  covariance += doubt_of_slips(filter);
  const double place_m2 = std::max(covariance(0, 0), covariance(1, 1));
  if (!(place_m2 < kMostSigma_m * kMostSigma_m) ||
      !(covariance(2, 2) < kMostSigma_rad * kMostSigma_rad)) {
    return std::nullopt;
  }
  return PredictedPose{t_ns, filter.pose(), covariance};
}

void Odometer::correct(const Pose2& T_map_base, const Covariance3& covariance) {
  if (!config_.enabled || !present_) return;
  ahead_is_stale_ = true;
  watch_for_slips(T_map_base, covariance);
  // What was guessed wrong the readings that are to come put right, not the fix.
  const Covariance3 of_guess = covariance + doubt_of_guess(guessed_ns());
  const Covariance3 most = with_floor(of_guess, 1, 1);
  if (filter_.is_contradictory()) {
    filter_.set_pose(T_map_base, most);
  } else if (has_pose_ && filter_.explains(T_map_base, most)) {
    const auto way_to = [&](const Pose2& pose) -> FixWatch::Way {
      return {pose.translation() - filter_.since_fix().start,
              angle_between(fixed_heading_rad_, pose.theta_rad)};
    };
    fix_watch_.add_explained(way_to(T_map_base), way_to(filter_.pose()));
    filter_.correct(T_map_base, learned_doubt(T_map_base, of_guess));
    ++fixes_;
  } else {
    if (has_pose_) add_stranger(T_map_base, most);
    filter_.set_pose(T_map_base, most);
  }
  has_pose_ = !filter_.is_contradictory();
  fixed_ns_ = middle_ns_;
  fixed_heading_rad_ = T_map_base.theta_rad;
  gyro_proof_.fixed(T_map_base.theta_rad);
  filter_.believe_gyro(!config_.conservative || gyro_proof_.holds());
  if (!learns_delay() || filter_.is_contradictory()) return;
  delays_.fixed(middle_ns_, T_map_base, covariance, path_);
  if (const auto delay_s = delays_.instead_of(filter_.learned().delay_s)) learn_anew(*delay_s);
}

double Odometer::delay_doubt_s2(double delay_s) const {
  if (!learns_delay()) return 0;
  return delays_.doubt_about(delay_s, config_.initial.delay_s, kUsualDelay * config_.noise.delay_s);
}

bool Odometer::may_miss_motion() const {
  return guessed_ns() > kPause_ns ||
         delay_doubt_s2(filter_.learned().delay_s) > kUnknownDelay_s * kUnknownDelay_s;
}

bool Odometer::learns_delay() const { return config_.noise.delay_s > 0; }

void Odometer::learn_anew(double delay_s) {
  OdometryParameters start = config_.initial;
  start.delay_s = delay_s;
  filter_.start_from(start);
  fix_watch_ = {};
  has_pose_ = false;
}

void Odometer::add_stranger(const Pose2& T_map_base, const Covariance3& covariance) {
  ++strangers_;
  const double surprise_rad = filter_.surprise_of(T_map_base)[2];
  const double known_rad2 = filter_.pose_covariance()(2, 2) + covariance(2, 2);
  fix_watch_.add_stranger(surprise_rad * surprise_rad > kUsual * known_rad2);
}

Covariance3 Odometer::learned_doubt(const Pose2& T_map_base, const Covariance3& covariance) {
  const Eigen::Vector3d surprise = filter_.surprise_of(T_map_base);
  const Covariance3 known = filter_.pose_covariance() + covariance;
  const auto needed = [&](int i, double floor) {
    const double floor2 = floor * floor;
    return (surprise[i] * surprise[i] / kUsual - known(i, i)) / floor2;
  };
  const double place = std::clamp(std::max(needed(0, kFixFloor_m), needed(1, kFixFloor_m)),
                                  place_floor_.factor(), 1.0);
  const double heading = std::clamp(needed(2, kFixFloor_rad), heading_floor_.factor(), 1.0);
  for (const int i : {0, 1}) {
    place_floor_.add(surprise[i] * surprise[i], kFixFloor_m * kFixFloor_m, known(i, i));
  }
  heading_floor_.add(surprise[2] * surprise[2], kFixFloor_rad * kFixFloor_rad, known(2, 2));
  return with_floor(covariance, place, heading);
}

void Odometer::set_pose(const Pose2& T_map_base, const Covariance3& covariance) {
  ahead_is_stale_ = true;
  filter_.set_pose(T_map_base, covariance);
  gyro_proof_.interrupt();
  has_pose_ = true;
  fixed_ns_ = middle_ns_;
}

}  // namespace cornerd::core
