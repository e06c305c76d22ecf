// SPDX-License-Identifier: MIT
#include "core/recognition/place_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cornerd::core {
namespace {

/// The logarithm of the number of places of a map that differ.
constexpr double kLogPlaces = 12;
/// Log odds of a place that one scan has shown.
const double kMostOfOneScan = std::log((1 - kLeastDoubt) / kLeastDoubt);
/// Log odds are of the best of a map's places. How much likelier they are at the right place than
/// at a given wrong one, nats: a line through the histogram of 16,000 right and 48,000 wrong places
/// (`cornerd-bench --evidence`, fit_evidence.py), which has hardly a wrong one beyond its limits.
constexpr double kEvenLogOdds = -14;
constexpr double kRatioPerLogOdds = 0.25;
constexpr double kLeastLogRatio = -3;
constexpr double kMostLogRatio = 8;
/// How far a robot moves between two scans, or from a prior that is exact.
constexpr double kNear_m = 0.25;
constexpr double kNear_rad = radians(20);
/// A prior that is less exact than that is wrong once in ten thousand times: its motion is a guess.
constexpr double kLogOddsOfVaguePrior = 9;

double log_ratio_at(double log_odds) {
  return std::clamp(kRatioPerLogOdds * (log_odds - kEvenLogOdds), kLeastLogRatio, kMostLogRatio);
}

}  // namespace

void PlaceFilter::confirm(const Pose2& T_map_lidar) {
  places_.front() = {T_map_lidar, T_map_lidar, kLogOddsAgainstCarried, 0, 0, true};
  count_ = 1;
}

void PlaceFilter::follow(const Pose2& T_map_lidar) {
  for (Place& place : std::span(places_).first(count_)) {
    place.is_named = same_pose(place.T_map_lidar, T_map_lidar, kNear_m, kNear_rad);
  }
  // Of two places that a hypothesis may be of it is the named one's.
  std::partition(places_.begin(), places_.begin() + static_cast<std::ptrdiff_t>(count_),
                 [](const Place& place) { return place.is_named; });
}

double PlaceFilter::weigh(Place& place, const Pose2& T_map_lidar, double evidence) {
  place.T_map_lidar = T_map_lidar;
  place.evidence += evidence;
  ++place.scans;
  const double way_m = (T_map_lidar.translation() - place.T_map_begin.translation()).norm();
  const double share = std::min(1.0, way_m / kIndependent_m);
  const double log_odds = place.base + share * log_ratio_at(place.evidence / place.scans);
  if (share == 1) {
    const double base = std::clamp(log_odds, -kLogPlaces, kLogOddsAgainstCarried);
    place = {T_map_lidar, T_map_lidar, base, 0, 0, place.is_named};
  }
  return log_odds;
}

const VerifiedHypothesis* PlaceFilter::find(Place& place, std::span<const VerifiedHypothesis> found,
                                            const std::optional<Prior>& prior) {
  const auto within = [&](const Pose2& T_map_lidar, double error_m, double error_rad) {
    const auto at = std::find_if(found.begin(), found.end(), [&](const auto& other) {
      return same_pose(T_map_lidar, other.refined.T_map_lidar, kNear_m + error_m,
                       kNear_rad + error_rad);
    });
    return at == found.end() ? nullptr : &*at;
  };
  const bool is_prior = place.is_named && prior;
  const bool is_vague =
      is_prior && (prior->position_error_m > kNear_m || prior->heading_error_rad > kNear_rad);
  if (!is_prior || is_vague) {
    const VerifiedHypothesis* const at = within(place.T_map_lidar, 0, 0);
    if (at || !is_prior) return at;
    // What the stretch before has shown is in the prior.
    place.base = std::min(place.base, kLogOddsOfVaguePrior);
    place.evidence = 0;
    place.scans = 0;
  }
  return within(prior->T_map_lidar, prior->position_error_m, prior->heading_error_rad);
}

void PlaceFilter::update(std::span<const VerifiedHypothesis> found,
                         const std::optional<Prior>& prior) {
  likeliest_.reset();
  doubt_ = 1;
  const std::size_t last_count = std::exchange(count_, 0);
  std::array<const VerifiedHypothesis*, kMaxPlaces> known{};
  std::array<double, kMaxPlaces> log_odds{};
  const auto is_known = [&](const VerifiedHypothesis* place) {
    const auto end = known.begin() + static_cast<std::ptrdiff_t>(count_);
    return std::find(known.begin(), end, place) != end;
  };
  const auto keep = [&](const Place& place, const VerifiedHypothesis* at, double now) {
    places_[count_] = place;
    known[count_] = at;
    log_odds[count_++] = now;
  };
  for (std::size_t i = 0; i < last_count; ++i) {
    Place place = places_[i];
    const VerifiedHypothesis* const at = find(place, found, prior);
    if (at && !is_known(at)) {
      const double now = weigh(place, at->refined.T_map_lidar, at->evidence);
      keep(place, at, now);
    } else if (!at && place.is_named && prior) {
      // That a scan does not show it is no evidence: it may be covered.
      keep(place, nullptr, place.base);
    }
  }
  for (const VerifiedHypothesis& place : found) {
    if (count_ == kMaxPlaces || place.log_odds <= kEvenLogOdds) break;
    if (is_known(&place)) continue;
    const Pose2& T_map_lidar = place.refined.T_map_lidar;
    const double start = std::min(place.log_odds, kMostOfOneScan);
    keep({T_map_lidar, T_map_lidar, start, 0, 0, false}, &place, start);
  }
  std::size_t best = count_;
  for (std::size_t i = 0; i < count_; ++i) {
    const bool speaks = known[i] && known[i]->evidence > kEvenLogOdds;
    if (speaks && (best == count_ || log_odds[i] > log_odds[best])) best = i;
  }
  if (best == count_) return;
  likeliest_ = static_cast<std::size_t>(known[best] - found.data());
  double others = std::exp(-log_odds[best]);  // elsewhere
  for (std::size_t i = 0; i < count_; ++i) {
    if (i != best) others += std::exp(log_odds[i] - log_odds[best]);
  }
  doubt_ = others / (1 + others);
}

}  // namespace cornerd::core
