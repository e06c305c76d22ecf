// SPDX-License-Identifier: MIT
#include "core/odometry/odometer.hpp"

#include <algorithm>
#include <cmath>

#include "core/odometry/dead_reckoning.hpp"

namespace cornerd::core {
namespace {

/// A prediction that is less sure than this helps nobody to find the place again.
constexpr double kMostSigma_m = 0.3;
constexpr double kMostSigma_rad = radians(15);
/// So many fixes in a row that the wheels cannot explain: they are not this robot's, or spin free.
constexpr std::uint32_t kDistrusted = 3;
/// What a fix may be off by that its covariance does not know of, a lidar's bias or a wall that was
/// mapped wrong, until the fixes themselves tell how much it is; a fix that belongs to the same
/// drive may be off by so much at any time.
constexpr double kFixFloor_m = 0.002;
constexpr double kFixFloor_rad = 0.001;
/// A surprise within three sigma needs no other reason.
constexpr double kUsual = 9;
/// How far wheels and gyro mistake the motion of half a turn, as a share of it.
constexpr double kMotionShare = 0.01;
/// What a turn's fix is off by of what wheels and gyro wander in it: a sample between its middle
/// and its end by a quarter of that, all of them together by a twelfth, and those that a coordinate
/// hangs on by something between (NEES of fixes, `cornerctl bench --odometry`).
constexpr double kWanderShare = 0.3;

/// A robot that is slower stands, or might as well: its gyro's noise is no motion, and what that
/// noise makes of the place would be taken for a delay.
constexpr double kLeastSpeed_m_s = 0.03;
constexpr double kLeastRate_rad_s = 0.1;

/// A change of speed between two readings moves what is between them by a quarter of what it comes
/// to at most, and a turn's samples are only in part there (NEES of fixes with few readings a
/// second, `cornerctl bench --odometry`).
constexpr double kUnevenShare = 0.2;

/// The paper's modes learn nothing: for them all is as it was configured.
OdometryConfig as_configured(OdometryConfig config) {
  if (config.mode != HeadingSource::kFilter) {
    OdometryNoise& noise = config.noise;
    noise.wheel_scale = noise.track_scale = noise.gyro_scale = noise.gyro_bias_rad_s = 0;
    noise.scale_per_sqrt_s = noise.bias_rad_s_per_sqrt_s = 0;
    noise.delay_s = noise.delay_s_per_sqrt_s = 0;
  }
  return config;
}

/// What of the step is left after what was guessed of it: all counts count once.
MotionStep less_guess(const MotionStep& step, MotionStep& guessed) {
  MotionStep rest = step;
  rest.left_m -= guessed.left_m;
  rest.right_m -= guessed.right_m;
  rest.gyro_rad -= guessed.gyro_rad;
  if (guessed.to_ns > guessed.from_ns) {
    rest.from_ns = std::min(guessed.to_ns, rest.to_ns - 1);
    if (guessed.has_gyro != step.has_gyro) rest.has_gyro = false;
  }
  guessed = {};
  return rest;
}

/// `place`, `heading`: shares of the floors' variances.
Covariance3 with_floor(const Covariance3& covariance, double place, double heading) {
  Covariance3 sum = covariance;
  sum(0, 0) += place * kFixFloor_m * kFixFloor_m;
  sum(1, 1) += place * kFixFloor_m * kFixFloor_m;
  sum(2, 2) += heading * kFixFloor_rad * kFixFloor_rad;
  return sum;
}

}  // namespace

Odometer::Odometer(const OdometryConfig& config)
    : config_(config), gate_(config), filter_(as_configured(config)), ahead_(filter_) {}

bool Odometer::add(const OdometryReading& reading, std::optional<TimeNs> now_ns) {
  if (!config_.enabled) return false;
  std::optional<MotionStep> step = gate_.add(reading, now_ns);
  if (!step) return false;
  if (step->to_ns < step->from_ns) {
    begin_anew(*step);
    return false;
  }
  if (config_.mode != HeadingSource::kFilter && !step->is_hole) {
    *step = by_wheels_alone(*step, config_.geometry, {config_.mode, config_.paper});
  }
  if (step->is_hole) {
    path_.clear();
  } else {
    path_.add(step->from_ns, step->to_ns, filter_.motion_of(*step));
  }
  if (size_ == kPending) {
    consume(pending_[first_]);
    first_ = (first_ + 1) % kPending;
    --size_;
    ahead_is_stale_ = true;
  }
  pending_[(first_ + size_++) % kPending] = *step;
  return true;
}

/// What waits is of times that never were, and how far the robot went meanwhile nobody knows.
void Odometer::begin_anew(const MotionStep& hole) {
  path_.clear();
  first_ = 0;
  size_ = 0;
  guessed_ = {};
  last_ = hole;
  reached_ns_ = hole.to_ns;
  ahead_is_stale_ = true;
  has_pose_ = false;
  filter_.doubt_times();
}

void Odometer::consume(const MotionStep& step) {
  // The lidar is well ahead of the readings.
  if (step.to_ns <= step.from_ns) return;
  filter_.predict(less_guess(step, guessed_));
  last_ = step;
  reached_ns_ = step.to_ns;
}

void Odometer::consume_until(TimeNs t_ns) {
  while (size_ > 0) {
    MotionStep& next = pending_[first_];
    if (next.from_ns >= t_ns) return;
    if (next.to_ns > t_ns) {
      consume(next.split(t_ns));
      return;
    }
    consume(next);
    first_ = (first_ + 1) % kPending;
    --size_;
  }
}

void Odometer::guess_until(TimeNs t_ns) {
  const TimeNs longest_ns = MotionPath::kLongestGuess_ns;
  if (size_ > 0 || t_ns <= reached_ns_ || t_ns > last_.to_ns + longest_ns) return;
  if (last_.is_hole || last_.to_ns <= last_.from_ns) return;
  const double share = to_seconds(t_ns - reached_ns_) / last_.duration_s();
  MotionStep guess = last_;
  guess.from_ns = reached_ns_;
  guess.to_ns = t_ns;
  guess.left_m *= share;
  guess.right_m *= share;
  guess.gyro_rad *= share;
  guess.gyro_change_rad = 0;
  filter_.predict(guess);
  if (guessed_.to_ns == guessed_.from_ns) guessed_.from_ns = reached_ns_;
  guessed_.to_ns = t_ns;
  guessed_.left_m += guess.left_m;
  guessed_.right_m += guess.right_m;
  guessed_.gyro_rad += guess.gyro_rad;
  guessed_.has_gyro = guess.has_gyro;
  reached_ns_ = t_ns;
}

void Odometer::advance(TimeNs start_ns, TimeNs middle_ns, TimeNs end_ns) {
  start_ns_ = start_ns;
  middle_ns_ = middle_ns;
  end_ns_ = end_ns;
  if (!config_.enabled) return;
  ahead_is_stale_ = true;
  delay_ns_ = from_seconds(filter_.learned().delay_s);
  const TimeNs reading_ns = middle_ns + delay_ns_;
  consume_until(reading_ns);
  guess_until(reading_ns);
  tell_velocity(filter_, reading_ns);
  if (filter_.is_contradictory()) has_pose_ = false;
  knows_motion_ = is_believed() && path_.covers(start_ns + delay_ns_, end_ns + delay_ns_);
  const TimeNs behind_ns = middle_ns - last_.to_ns;
  present_ = behind_ns >= -kNsPerSecond && behind_ns <= MotionPath::kLongestGuess_ns;
  if (!present_) has_pose_ = false;
}

void Odometer::tell_velocity(FusionFilter& filter, TimeNs t_ns) const {
  const Twist2 velocity = path_.velocity_at(t_ns);
  const bool drives = std::abs(velocity.vx_m_s) > kLeastSpeed_m_s ||
                      std::abs(velocity.omega_rad_s) > kLeastRate_rad_s;
  filter.set_velocity(drives ? velocity.vx_m_s : 0, drives ? velocity.omega_rad_s : 0);
}

bool Odometer::straighten(const Scan& turn, const Pose2& T_base_lidar, Scan& still) const {
  if (!knows_motion_) return false;
  // The way from one of these to the next, 2 ms, is straight enough.
  constexpr std::size_t kPieces = 64;
  std::array<Pose2, kPieces + 1> T_middle_then;
  const Pose2 T_middle_start = (path_.at(middle_ns_ + delay_ns_) * T_base_lidar).inverse();
  const double piece_ns = static_cast<double>(end_ns_ - start_ns_) / kPieces;
  for (std::size_t i = 0; i <= kPieces; ++i) {
    const TimeNs t_ns = start_ns_ + static_cast<TimeNs>(static_cast<double>(i) * piece_ns);
    T_middle_then[i] = T_middle_start * path_.at(t_ns + delay_ns_) * T_base_lidar;
  }
  still.clear();
  for (const Sample& sample : turn.samples()) {
    Sample moved = sample;
    if (sample.range_m > 0) {
      const double piece = static_cast<double>(sample.t_ns - start_ns_) / std::max(piece_ns, 1.0);
      const auto i = static_cast<std::size_t>(std::clamp(piece, 0.0, kPieces - 1.0));
      const double share = piece - static_cast<double>(i);
      const Pose2& from = T_middle_then[i];
      const Pose2& to = T_middle_then[i + 1];
      const double turn_rad = from.theta_rad + share * angle_between(from.theta_rad, to.theta_rad);
      const Vec2 place = from.translation() + share * (to.translation() - from.translation()) +
                         sample.range_m * unit_vector(turn_rad + sample.bearing_rad);
      moved.bearing_rad = static_cast<float>(std::atan2(place.y(), place.x()));
      moved.range_m = static_cast<float>(place.norm());
    }
    still.add(moved);
  }
  return true;
}

Covariance3 Odometer::doubt_of_motion() const {
  const TimeNs from_ns = start_ns_ + delay_ns_;
  const TimeNs to_ns = end_ns_ + delay_ns_;
  const Pose2 way = path_.at(from_ns).inverse() * path_.at(to_ns);
  const double place_m = kMotionShare / 2 * way.translation().norm();
  const double turn_rad = kMotionShare / 2 * way.theta_rad;
  const FusionFilter::Wander wander =
      filter_.wander_of(way, to_seconds(end_ns_ - start_ns_), last_.has_gyro);
  // When between two readings the robot changed its speed nobody knows.
  const Pose2 uneven = path_.greatest_change(from_ns, to_ns);
  const double uneven_m = kUnevenShare * uneven.x_m;
  const double uneven_rad = kUnevenShare * uneven.theta_rad;
  // Where in its count each wheel is in the middle: what the rest of the turn is straightened to.
  const DriveGeometry& geometry = config_.geometry;
  const double place_m2 = place_m * place_m + uneven_m * uneven_m + geometry.rest_m2() / 2 +
                          kWanderShare * wander.place_m2;
  double turn_rad2 =
      turn_rad * turn_rad + uneven_rad * uneven_rad + kWanderShare * wander.turn_rad2;
  if (!last_.has_gyro) turn_rad2 += 2 * geometry.rest_m2() / (geometry.track_m * geometry.track_m);
  return Eigen::Vector3d(place_m2, place_m2, turn_rad2).asDiagonal();
}

std::optional<PredictedPose> Odometer::prediction() const {
  return prediction_of(filter_, middle_ns_);
}

std::optional<PredictedPose> Odometer::ahead() {
  if (ahead_is_stale_) {
    ahead_ = filter_;
    ahead_guessed_ = guessed_;
    ahead_by_ = 0;
    ahead_is_stale_ = false;
  }
  for (; ahead_by_ < size_; ++ahead_by_) {
    const MotionStep& step = pending_[(first_ + ahead_by_) % kPending];
    if (step.to_ns > step.from_ns) ahead_.predict(less_guess(step, ahead_guessed_));
  }
  if (size_ == 0) return std::nullopt;
  const TimeNs t_ns = pending_[(first_ + size_ - 1) % kPending].to_ns;
  tell_velocity(ahead_, t_ns);
  const TimeNs then_ns = t_ns - from_seconds(filter_.learned().delay_s);
  return then_ns > middle_ns_ ? prediction_of(ahead_, then_ns) : std::nullopt;
}

std::optional<PredictedPose> Odometer::prediction_of(const FusionFilter& filter,
                                                     TimeNs t_ns) const {
  if (!has_pose_ || !present_ || !is_believed() || filter.is_contradictory()) return std::nullopt;
  if (to_seconds(t_ns - fixed_ns_) > config_.bridge_s) return std::nullopt;
  const Covariance3 covariance = filter.pose_covariance();
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
  const Covariance3 most = with_floor(covariance, 1, 1);
  if (filter_.is_contradictory()) {
    filter_.set_pose(T_map_base, most);
  } else if (has_pose_ && filter_.explains(T_map_base, most)) {
    filter_.correct(T_map_base, learned_doubt(T_map_base, covariance));
    strangers_in_a_row_ = 0;
    ++fixes_;
  } else {
    if (has_pose_) {
      ++strangers_in_a_row_;
      ++strangers_;
    }
    filter_.set_pose(T_map_base, most);
  }
  has_pose_ = !filter_.is_contradictory();
  fixed_ns_ = middle_ns_;
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

void Odometer::disbelieve_motion() { knows_motion_ = false; }

void Odometer::set_pose(const Pose2& T_map_base, const Covariance3& covariance) {
  ahead_is_stale_ = true;
  filter_.set_pose(T_map_base, covariance);
  has_pose_ = true;
  fixed_ns_ = middle_ns_;
}

bool Odometer::is_believed() const {
  return strangers_in_a_row_ < kDistrusted && !filter_.is_contradictory();
}

void Odometer::forget() {
  has_pose_ = false;
  strangers_in_a_row_ = 0;
}

OdometrySummary Odometer::summary() const {
  OdometrySummary summary;
  summary.enabled = config_.enabled;
  summary.present = present_;
  summary.trusted = present_ && is_believed();
  summary.learned = filter_.learned();
  const auto sigma = [&](FusionFilter::Index i) { return std::sqrt(filter_.covariance()(i, i)); };
  summary.sigma = {sigma(FusionFilter::kBias),  sigma(FusionFilter::kLeft),
                   sigma(FusionFilter::kRight), sigma(FusionFilter::kTrack),
                   sigma(FusionFilter::kGyro),  sigma(FusionFilter::kDelay)};
  summary.counters = gate_.counters();
  summary.slips = filter_.slips();
  summary.fixes = fixes_;
  summary.strangers = strangers_;
  return summary;
}

}  // namespace cornerd::core
