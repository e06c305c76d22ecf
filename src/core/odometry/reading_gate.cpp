// SPDX-License-Identifier: MIT
#include "core/odometry/reading_gate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/odometry/wrapping_counter.hpp"

namespace cornerd::core {
namespace {

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
  jitter_.interrupt();
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
  jitter_.add(step.left_m, step.right_m, step.duration_s(), geometry.quantization_variance());
  step.jitter_s2 = jitter_.variance_between_s2();
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
