// SPDX-License-Identifier: MIT
// The times of readings: late, early, or of a clock that was set.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/odometry/reading_gate.hpp"

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
/// A recorded scan may come as a whole: how far ahead of it readings are shows when it has come.
constexpr TimeNs kSlowestScan_ns = kNsPerSecond * 5 / 4;
/// How fast the period of the readings is learned.
constexpr double kPeriodShare = 1.0 / 16;

}  // namespace

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
  if (!compared_since_ns_ || t_ns - *compared_since_ns_ > kSlowestScan_ns) {
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

}  // namespace cornerd::core
