// SPDX-License-Identifier: MIT
#include "core/odometry/odometer.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// A robot that is slower stands, or might as well: its gyro's noise is no motion, and what that
/// noise makes of the place would be taken for a delay.
constexpr double kLeastSpeed_m_s = 0.03;
constexpr double kLeastRate_rad_s = 0.1;

/// The delay that is learned wavers by less.
constexpr TimeNs kMostWavering_ns = 20'000'000;

/// What of the step is left after what was guessed of it: all counts count once.
OdometryIncrement less_guess(const OdometryIncrement& step, OdometryIncrement& guessed) {
  OdometryIncrement rest = step;
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

}  // namespace

Odometer::Odometer(const OdometryConfig& config)
    : config_(config), gate_(config), filter_(config), ahead_(filter_) {
  filter_.believe_gyro(!config.conservative);
}

bool Odometer::add(const OdometryReading& reading, std::optional<TimeNs> now_ns) {
  if (!config_.enabled) return false;
  std::optional<OdometryIncrement> step = gate_.add(reading, now_ns);
  if (!step) return false;
  if (step->to_ns < step->from_ns) {
    begin_anew(*step);
    return false;
  }
  if (step->is_gap) {
    path_.clear();
    delays_.interrupt();
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
void Odometer::begin_anew(const OdometryIncrement& hole) {
  path_.clear();
  delays_.interrupt();
  gyro_proof_.interrupt();
  first_ = 0;
  size_ = 0;
  guessed_ = {};
  last_ = hole;
  reached_ns_ = hole.to_ns;
  ahead_is_stale_ = true;
  has_pose_ = false;
  filter_.doubt_times();
}

void Odometer::consume(const OdometryIncrement& step) {
  // The lidar is well ahead of the readings.
  if (step.to_ns <= step.from_ns) return;
  const OdometryIncrement rest = less_guess(step, guessed_);
  filter_.predict(rest);
  gyro_proof_.drove(rest);
  last_ = step;
  reached_ns_ = step.to_ns;
}

void Odometer::consume_until(TimeNs t_ns) {
  while (size_ > 0) {
    OdometryIncrement& next = pending_[first_];
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
  if (last_.is_gap || last_.to_ns <= last_.from_ns) return;
  const double share = to_seconds(t_ns - reached_ns_) / last_.duration_s();
  OdometryIncrement guess = last_;
  guess.from_ns = reached_ns_;
  guess.to_ns = t_ns;
  guess.left_m *= share;
  guess.right_m *= share;
  guess.gyro_rad *= share;
  guess.gyro_change_rad = 0;
  filter_.predict(guess);
  gyro_proof_.drove(guess);
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
  // The readings were taken to be earlier until now: the filter is ahead.
  if (reached_ns_ > reading_ns + kMostWavering_ns) has_pose_ = false;
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

std::optional<PredictedPose> Odometer::predict_latest() {
  if (ahead_is_stale_) {
    ahead_ = filter_;
    ahead_guessed_ = guessed_;
    ahead_by_ = 0;
    ahead_is_stale_ = false;
  }
  for (; ahead_by_ < size_; ++ahead_by_) {
    const OdometryIncrement& step = pending_[(first_ + ahead_by_) % kPending];
    if (step.to_ns > step.from_ns) ahead_.predict(less_guess(step, ahead_guessed_));
  }
  if (size_ == 0) return std::nullopt;
  const TimeNs t_ns = pending_[(first_ + size_ - 1) % kPending].to_ns;
  tell_velocity(ahead_, t_ns);
  const TimeNs then_ns = t_ns - from_seconds(filter_.learned().delay_s);
  return then_ns > middle_ns_ ? prediction_of(ahead_, then_ns, 0) : std::nullopt;
}

bool Odometer::is_believed() const {
  const bool lies = config_.conservative ? !fix_watch_.is_believed() : fix_watch_.is_contradicted();
  return !lies && !filter_.is_contradictory();
}

void Odometer::forget() {
  has_pose_ = false;
  fix_watch_.interrupt();
  gyro_proof_.interrupt();
}

OdometrySummary Odometer::summary() const {
  OdometrySummary summary;
  summary.enabled = config_.enabled;
  summary.present = present_;
  summary.healthy = present_ && is_believed();
  summary.parameters = filter_.learned();
  const auto sigma = [&](FusionFilter::Index i) { return std::sqrt(filter_.covariance()(i, i)); };
  summary.sigma = {sigma(FusionFilter::kBias),  sigma(FusionFilter::kLeft),
                   sigma(FusionFilter::kRight), sigma(FusionFilter::kTrack),
                   sigma(FusionFilter::kGyro),  sigma(FusionFilter::kDelay)};
  summary.sigma.delay_s =
      std::hypot(summary.sigma.delay_s, std::sqrt(delay_doubt_s2(summary.parameters.delay_s)));
  summary.counters = gate_.counters();
  summary.slips = filter_.slips();
  summary.fixes = fixes_;
  summary.rejected_fixes = strangers_;
  return summary;
}

}  // namespace cornerd::core
