// SPDX-License-Identifier: MIT
#include "core/odometry/delay_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/angle.hpp"
#include "core/geometry/parabola.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// A turn that was deskewed by readings of another time is off by more than it says.
constexpr double kFix_m = 0.005;
constexpr double kFix_rad = 0.008;
/// Scales that have yet to be learned.
constexpr double kScaleShare = 0.04;
/// Longer from fix to fix, and half a circle might be missed.
constexpr TimeNs kLongestPair_ns = kNsPerSecond / 2;
/// One surprise says no more than so much: a slip, a wrong fix.
constexpr double kMostOfAPair = 16;
/// Delays that differ by less than this in what they expect of a pair: it tells nothing.
constexpr double kTelling = 1;
/// Of what was seen before, with each pair that tells: 30 of them count.
constexpr double kKept = 1 - 1.0 / 30;

/// The share of robots whose readings are late by anything.
constexpr double kElse = 0.03;
/// Pairs share their fixes, and what one is off by is in both.
constexpr double kShared = 2;

/// So much must speak against the present delay, and against all but the neighbours of the new one.
constexpr double kAgainst = 40;
constexpr double kAgainstOthers = 15;
constexpr double kFewestPairs = 6;
/// A mean surprise above this: no delay explains what is seen.
constexpr double kUnexplained = 3;

}  // namespace

void DelayFinder::fixed(TimeNs t_ns, const Pose2& T_map_base, const Covariance3& covariance,
                        const MotionPath& path) {
  if (waiting_ == kWaiting) interrupt();
  const double place_m2 = std::max(covariance(0, 0), covariance(1, 1));
  fixes_[waiting_++] = {t_ns, T_map_base, place_m2, covariance(2, 2)};
  const TimeNs margin_ns = from_seconds(delay_s(kDelays - 1));
  while (waiting_ > 1) {
    const TimeNs from_ns = fixes_[0].t_ns - margin_ns;
    const TimeNs to_ns = fixes_[1].t_ns + margin_ns;
    if (!path.covers(to_ns, to_ns + MotionPath::kLongestGuess_ns)) return;
    if (fixes_[1].t_ns - fixes_[0].t_ns < kLongestPair_ns && path.covers(from_ns, to_ns)) {
      compare(fixes_[0], fixes_[1], path);
    }
    std::shift_left(fixes_.begin(), fixes_.begin() + static_cast<std::ptrdiff_t>(waiting_), 1);
    --waiting_;
  }
}

void DelayFinder::compare(const Fix& from, const Fix& to, const MotionPath& path) {
  const Pose2 seen = from.T_map_base.inverse() * to.T_map_base;
  const double way_m = seen.translation().norm();
  const double place_m2 =
      from.place_m2 + to.place_m2 + squared(kFix_m) + squared(kScaleShare * way_m);
  const double heading_rad2 = from.heading_rad2 + to.heading_rad2 + squared(kFix_rad) +
                              squared(kScaleShare * seen.theta_rad);
  std::array<double, kDelays> ways{};
  std::array<double, kDelays> turns{};
  std::array<double, kDelays> surprises{};
  for (std::size_t i = 0; i < kDelays; ++i) {
    const TimeNs late_ns = from_seconds(delay_s(i));
    const Pose2 told = path.at(from.t_ns + late_ns).inverse() * path.at(to.t_ns + late_ns);
    ways[i] = told.translation().norm();
    turns[i] = told.theta_rad;
    surprises[i] = squared(ways[i] - way_m) / place_m2 +
                   squared(angle_between(told.theta_rad, seen.theta_rad)) / heading_rad2;
  }
  const auto [least_m, most_m] = std::ranges::minmax(ways);
  const auto [least_rad, most_rad] = std::ranges::minmax(turns);
  if (squared(most_m - least_m) < kTelling * place_m2 &&
      squared(most_rad - least_rad) < kTelling * heading_rad2) {
    return;
  }
  pairs_ = kKept * pairs_ + 1;
  for (std::size_t i = 0; i < kDelays; ++i) {
    cost_[i] = kKept * cost_[i] + std::min(surprises[i], kMostOfAPair);
  }
}

double DelayFinder::cost_of(double late_s) const {
  const double at = std::clamp(late_s / kStep_s + kMost, 0.0, double{2 * kMost} - 1e-9);
  const auto i = static_cast<std::size_t>(at);
  const double share = at - static_cast<double>(i);
  return (1 - share) * cost_[i] + share * cost_[i + 1];
}

std::optional<double> DelayFinder::instead_of(double late_s) const {
  const auto best = static_cast<std::size_t>(std::ranges::min_element(cost_) - cost_.begin());
  const double least = cost_[best];
  if (pairs_ < kFewestPairs || least > kUnexplained * pairs_) return std::nullopt;
  if (best == 0 || best == kDelays - 1) return std::nullopt;
  const double found_s =
      delay_s(best) + kStep_s * parabola_minimum(cost_[best - 1] - least, cost_[best + 1] - least);
  if (std::abs(found_s - late_s) < kStep_s || cost_of(late_s) < least + kAgainst) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < kDelays; ++i) {
    const bool is_near = i + 2 >= best && i <= best + 2;
    if (!is_near && cost_[i] < least + kAgainstOthers) return std::nullopt;
  }
  return found_s;
}

double DelayFinder::doubt_about(double late_s, double first_s, double usual_s) const {
  std::array<double, kDelays> usual{};
  for (std::size_t i = 0; i < kDelays; ++i) {
    usual[i] = std::exp(-squared((delay_s(i) - first_s) / usual_s) / 2);
  }
  const double all = std::accumulate(usual.begin(), usual.end(), 0.0);
  const double least = *std::ranges::min_element(cost_);
  double weights = 0;
  double sum_s2 = 0;
  for (std::size_t i = 0; i < kDelays; ++i) {
    const double before = all > 0 ? (1 - kElse) * usual[i] / all : 0;
    const double weight =
        (before + kElse / kDelays) * std::exp(-(cost_[i] - least) / (2 * kShared));
    weights += weight;
    sum_s2 += weight * squared(delay_s(i) - late_s);
  }
  return std::max(0.0, sum_s2 / weights - squared(kStep_s));
}

}  // namespace cornerd::core
