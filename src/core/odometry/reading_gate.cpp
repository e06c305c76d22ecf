// SPDX-License-Identifier: MIT
#include "core/odometry/reading_gate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/odometry/wrapping_counter.hpp"

namespace cornerd::core {
namespace {

/// What is so old is of a wrong clock.
constexpr TimeNs kMostBehind_ns = 5 * kNsPerSecond;
/// So many readings in a row that are before the last one, and in order, are no accident: the
/// client's clock was set.
constexpr std::uint32_t kClockWasSet = 5;
/// A reading so much later than its period is the next one after a pause where the ones that follow
/// go on from it, and of the future where they come before it.
constexpr double kTypicalPeriods = 3;
constexpr double kShortestLeap_s = 0.06;
constexpr std::uint32_t kWentOn = 3;
constexpr double kSlower = 1.5;
/// What comes so much faster than its period was held back, and bears the time when it was let go.
constexpr double kBunched = 0.34;
/// A leap that is longer by this than the time that the lidar saw go by is one of the clock, and a
/// clock that is always so far ahead is a wrong one.
constexpr TimeNs kClockAhead_ns = kNsPerSecond / 4;
/// A recorded turn may come as a whole: how far ahead of it readings are shows when it has come.
constexpr TimeNs kSlowTurn_ns = kNsPerSecond * 5 / 4;
/// How fast the period of the readings is learned.
constexpr double kPeriodShare = 1.0 / 16;
/// Counts that jumped and then go on evenly so often are a controller that was restarted.
constexpr std::uint32_t kRestarted = 3;
/// Counts farther apart say where the robot went, not how.
constexpr TimeNs kLongestStep_ns = kNsPerSecond;
/// Between two rates of a gyro that is there.
constexpr double kLongestGyroGap_s = 0.2;
constexpr double kGyroCoverage = 0.8;
/// A gyro that has said the same so often may be stuck, or at rest while a wheel slips.
constexpr std::uint32_t kSuspiciousRates = 3;
/// A gyro that has said the same so often while wheels and it came this far apart is stuck.
constexpr std::uint32_t kFrozenRates = 10;
constexpr double kFrozen_rad = 0.15;
/// A wheel that spins up at once, and what it gains in a longer time: more is a wrong count.
constexpr double kMostChange_m_s = 1;
constexpr double kMostChange_m_s2 = 10;
/// Two encoders that tick between the same two readings.
constexpr double kSlackCounts = 2;

}  // namespace

std::optional<OdometryIncrement> ReadingGate::add(const OdometryReading& reading) {
  ++counters_.readings;
  if (!is_in_time(reading.t_ns, reading.arrival_ns)) return std::nullopt;
  if (reading.gyro_rad_s) add_gyro(reading.t_ns, *reading.gyro_rad_s);
  if (!reading.left || !reading.right) return std::nullopt;
  return add_counts({reading.t_ns, *reading.left, *reading.right});
}

bool ReadingGate::is_in_time(TimeNs t_ns, std::optional<TimeNs> arrival_ns) {
  if (arrival_ns && t_ns > *arrival_ns + from_seconds(config_.limits.ahead_s)) {
    ++counters_.future;
    return false;
  }
  if (arrival_ns && t_ns < *arrival_ns - kMostBehind_ns) {
    ++counters_.past;
    return false;
  }
  const std::optional<TimeNs> clock_ns = config_.conservative ? arrival_ns : std::nullopt;
  if (last_ns_ && t_ns < *last_ns_) {
    ++counters_.past;
    refused_in_a_row_ = refused_ns_ && t_ns < *refused_ns_ ? 1 : refused_in_a_row_ + 1;
    refused_ns_ = t_ns;
    if (refused_in_a_row_ < kClockWasSet) return false;
    ++counters_.restarts;
    clock_was_set_back_ = true;
    gyro_ns_.reset();
  } else if (clock_ns && is_always_ahead(t_ns, *clock_ns)) {
    ++counters_.future;
    return false;
  } else if (leaps_ahead(t_ns, clock_ns)) {
    return false;
  }
  refused_in_a_row_ = 0;
  refused_ns_.reset();
  last_ns_ = t_ns;
  last_arrival_ns_ = arrival_ns;
  return true;
}

bool ReadingGate::is_always_ahead(TimeNs t_ns, TimeNs arrival_ns) {
  const TimeNs ahead_ns = t_ns - arrival_ns;
  if (!compared_since_ns_ || t_ns - *compared_since_ns_ > kSlowTurn_ns) {
    least_ahead_before_ns_ = std::exchange(least_ahead_ns_, ahead_ns);
    compared_since_ns_ = t_ns;
  }
  least_ahead_ns_ = std::min(least_ahead_ns_, ahead_ns);
  return std::min(least_ahead_ns_, least_ahead_before_ns_) > kClockAhead_ns;
}

bool ReadingGate::clock_leapt(TimeNs t_ns, TimeNs arrival_ns) const {
  if (!last_ns_ || !last_arrival_ns_ || t_ns < arrival_ns + kClockAhead_ns) return false;
  return (t_ns - *last_ns_) - (arrival_ns - *last_arrival_ns_) > kClockAhead_ns;
}

bool ReadingGate::leaps_ahead(TimeNs t_ns, std::optional<TimeNs> clock_ns) {
  if (!last_ns_) return false;
  const double pause_s = to_seconds(t_ns - *last_ns_);
  const double longest_s = std::max(kShortestLeap_s, kTypicalPeriods * period_s_.value_or(pause_s));
  if (pause_s > longest_s) {
    // Or as slowly as after the pause: a client that has less to do.
    const bool goes_on =
        leapt_ns_ && t_ns >= *leapt_ns_ &&
        to_seconds(t_ns - *leapt_ns_) <=
            std::max(longest_s, kSlower * to_seconds(*leapt_ns_ - *last_ns_) / leaps_);
    if (config_.conservative && goes_on && period_s_ &&
        to_seconds(t_ns - *leapt_ns_) < kBunched * *period_s_) {
      ++counters_.past;
      return true;
    }
    counters_.future += goes_on ? 0 : leaps_;
    const double followed_s = goes_on ? to_seconds(t_ns - *leapt_ns_) : 0;
    leaps_ = goes_on ? leaps_ + 1 : 1;
    leapt_ns_ = t_ns;
    if (leaps_ < kWentOn) return true;
    if (clock_ns && clock_leapt(t_ns, *clock_ns)) {
      ++counters_.future;
      leaps_ = kWentOn - 1;
      return true;
    }
    period_s_ = followed_s;
  } else {
    counters_.future += leaps_;
    period_s_ =
        period_s_.value_or(pause_s) + kPeriodShare * (pause_s - period_s_.value_or(pause_s));
  }
  leaps_ = 0;
  leapt_ns_.reset();
  return false;
}

void ReadingGate::add_gyro(TimeNs t_ns, double rate_rad_s) {
  if (!(std::abs(rate_rad_s) <= config_.limits.gyro_rad_s)) {
    ++counters_.invalid_rates;
    return;
  }
  if (rate_rad_s != gyro_rad_s_) {
    same_rates_ = 0;
    turned_since_rad_ = 0;
    gyro_is_stuck_ = false;
  } else {
    ++same_rates_;
  }
  if (gyro_ns_) {
    const double dt_s = to_seconds(t_ns - *gyro_ns_);
    if (dt_s <= kLongestGyroGap_s) {
      gyro_rad_ += dt_s * (gyro_rad_s_ + rate_rad_s) / 2;
      gyro_change_rad_ += dt_s * std::abs(rate_rad_s - gyro_rad_s_) / 2;
      gyro_covered_s_ += dt_s;
    }
  }
  gyro_ns_ = t_ns;
  gyro_rad_s_ = rate_rad_s;
}

bool ReadingGate::is_possible(const Counts& from, const Counts& to) const {
  const DriveGeometry& geometry = config_.geometry;
  const double most = kSlackCounts + config_.limits.wheel_speed_m_s *
                                         to_seconds(to.t_ns - from.t_ns) /
                                         geometry.metres_per_count();
  const auto within = [&](std::int64_t a, std::int64_t b) {
    return std::abs(static_cast<double>(count_difference(a, b, geometry.counter_max))) <= most;
  };
  return to.t_ns > from.t_ns && within(from.left, to.left) && within(from.right, to.right);
}

bool ReadingGate::is_sudden(const Counts& before, const Counts& from, const Counts& to) const {
  const DriveGeometry& geometry = config_.geometry;
  const double before_s = to_seconds(from.t_ns - before.t_ns);
  const double dt_s = to_seconds(to.t_ns - from.t_ns);
  if (!(before_s > 0) || !(dt_s > 0)) return false;
  const double slack_m = 2 * kSlackCounts * geometry.metres_per_count();
  const double most_m = slack_m + dt_s * (kMostChange_m_s + kMostChange_m_s2 * dt_s);
  const auto changes = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
    const auto earlier = static_cast<double>(count_difference(a, b, geometry.counter_max));
    const auto later = static_cast<double>(count_difference(b, c, geometry.counter_max));
    return std::abs(later - earlier * dt_s / before_s) * geometry.metres_per_count() > most_m;
  };
  return changes(before.left, from.left, to.left) || changes(before.right, from.right, to.right);
}

std::optional<OdometryIncrement> ReadingGate::add_counts(const Counts& counts) {
  if (!last_) {
    last_ = counts;
    OdometryIncrement before;
    take_gyro(before);
    return std::nullopt;
  }
  if (clock_was_set_back_) {
    clock_was_set_back_ = false;
    return restart(counts);
  }
  if (counts.t_ns == last_->t_ns) {
    ++counters_.past;
    return std::nullopt;
  }
  const bool is_jump = !is_possible(*last_, counts);
  const bool agrees = doubted_ && is_possible(*doubted_, counts);
  const bool is_glitch = config_.conservative && before_last_ &&
                         is_sudden(*before_last_, *last_, counts) &&
                         !(agrees && !is_sudden(*last_, *doubted_, counts));
  if (is_jump || is_glitch) {
    ++counters_.jumps;
    doubts_ = agrees ? doubts_ + 1 : 1;
    doubted_ = counts;
    if (doubts_ < kRestarted) return std::nullopt;
    if (is_jump) {
      ++counters_.restarts;
      return restart(counts);
    }
  }
  doubted_.reset();
  if (counts.t_ns - last_->t_ns > kLongestStep_ns) return restart(counts);

  before_last_ = last_;
  OdometryIncrement step = step_between(*last_, counts);
  last_ = counts;
  return step;
}

std::optional<OdometryIncrement> ReadingGate::restart(const Counts& counts) {
  ++counters_.gaps;
  OdometryIncrement hole;
  hole.from_ns = last_->t_ns;
  hole.to_ns = counts.t_ns;
  hole.is_gap = true;
  take_gyro(hole);
  last_ = counts;
  before_last_.reset();
  doubted_.reset();
  doubts_ = 0;
  return hole;
}

OdometryIncrement ReadingGate::step_between(const Counts& from, const Counts& to) {
  const DriveGeometry& geometry = config_.geometry;
  const auto way_m = [&](std::int64_t a, std::int64_t b) {
    return static_cast<double>(count_difference(a, b, geometry.counter_max)) *
           geometry.metres_per_count();
  };
  OdometryIncrement step;
  step.from_ns = from.t_ns;
  step.to_ns = to.t_ns;
  step.left_m = way_m(from.left, to.left);
  step.right_m = way_m(from.right, to.right);
  take_gyro(step);
  step.gyro_may_be_stuck = same_rates_ >= kSuspiciousRates;
  if (step.has_gyro && gyro_is_stuck(step)) step.has_gyro = false;
  return step;
}

void ReadingGate::take_gyro(OdometryIncrement& step) {
  const double duration_s = step.duration_s();
  // What is not covered is a small part, or the rate holds on.
  if (gyro_covered_s_ > 0 && gyro_covered_s_ >= kGyroCoverage * duration_s) {
    const double share = duration_s / gyro_covered_s_;
    step.gyro_rad = gyro_rad_ * share;
    step.gyro_change_rad = gyro_change_rad_ * share;
    step.has_gyro = true;
  }
  gyro_rad_ = 0;
  gyro_change_rad_ = 0;
  gyro_covered_s_ = 0;
}

bool ReadingGate::gyro_is_stuck(const OdometryIncrement& step) {
  turned_since_rad_ += (step.right_m - step.left_m) / config_.geometry.track_m - step.gyro_rad;
  // A robot that turns back comes near the stuck rate again: it stays stuck until it changes.
  if (same_rates_ >= kFrozenRates && std::abs(turned_since_rad_) >= kFrozen_rad) {
    gyro_is_stuck_ = true;
  }
  if (gyro_is_stuck_) ++counters_.stuck;
  return gyro_is_stuck_;
}

}  // namespace cornerd::core
