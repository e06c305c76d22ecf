// SPDX-License-Identifier: MIT
#include "core/recognition/place_filter.hpp"

#include <algorithm>
#include <limits>

namespace cornerd::core {
namespace {

/// Scans so far apart show other walls, or other things before them. Between 0.5 and 4 m it makes
/// no difference to drives in maps that are 3 cm off, among 30 to 40 % of clutter, and in wrong
/// maps.
constexpr double kIndependent_m = 2;
/// Log odds of the best of a map's places are by chance so much higher than those of one given
/// place, which is not searched for: the logarithm of the number of places that differ.
constexpr double kLogPlaces = 12;
/// How far a robot moves between two scans, or from a prior that is exact.
constexpr double kNear_m = 0.25;
constexpr double kNear_rad = radians(20);

}  // namespace

void PlaceFilter::confirm(const Pose2& T_map_lidar) {
  places_.front() = {T_map_lidar, T_map_lidar, kLogOddsAgainstCarried, 0, true};
  count_ = 1;
}

void PlaceFilter::follow(const Pose2& T_map_lidar) {
  for (Place& place : std::span(places_).first(count_)) {
    place.is_named = same_pose(place.T_map_lidar, T_map_lidar, kNear_m, kNear_rad);
  }
}

double PlaceFilter::weigh(Place& place, const Pose2& T_map_lidar, double evidence) {
  const double way_m = (T_map_lidar.translation() - place.T_map_anchor.translation()).norm();
  const double fresh = std::min(1.0, way_m / kIndependent_m);
  const double log_odds = place.base + fresh * place.anchored + evidence;
  if (fresh == 1) {
    place.base = std::min(kLogOddsAgainstCarried, place.base + place.anchored);
    place.anchored = evidence;
    place.T_map_anchor = T_map_lidar;
  }
  place.T_map_lidar = T_map_lidar;
  return log_odds;
}

const VerifiedHypothesis* PlaceFilter::find(const Place& place,
                                            std::span<const VerifiedHypothesis> found,
                                            const std::optional<Prior>& prior) {
  const bool is_prior = place.is_named && prior;
  const Pose2& T_map_lidar = is_prior ? prior->T_map_lidar : place.T_map_lidar;
  const double near_m = kNear_m + (is_prior ? prior->position_error_m : 0);
  const double near_rad = kNear_rad + (is_prior ? prior->heading_error_rad : 0);
  const auto at = std::find_if(found.begin(), found.end(), [&](const auto& other) {
    return same_pose(T_map_lidar, other.refined.T_map_lidar, near_m, near_rad);
  });
  return at == found.end() ? nullptr : &*at;
}

void PlaceFilter::update(std::span<const VerifiedHypothesis> found,
                         const std::optional<Prior>& prior) {
  likeliest_.reset();
  log_odds_ = -std::numeric_limits<double>::infinity();
  const auto evidence_for = [&](const VerifiedHypothesis& place, double log_odds_elsewhere) {
    for (const VerifiedHypothesis& other : found) {
      if (&other != &place) log_odds_elsewhere = std::max(log_odds_elsewhere, other.log_odds);
    }
    return place.log_odds - log_odds_elsewhere;
  };
  std::array<const VerifiedHypothesis*, kMaxPlaces> known{};
  // Of the place that was named last, where this scan does not show it: it speaks against others.
  double log_odds_of_unseen = 0;
  std::size_t kept = 0;
  for (const Place& last : std::span(places_).first(count_)) {
    Place place = last;
    const VerifiedHypothesis* const at = find(place, found, prior);
    if (!at && !(place.is_named && prior)) continue;
    if (!at) log_odds_of_unseen = std::max(log_odds_of_unseen, place.base);
    if (at) {
      if (std::find(known.begin(), known.end(), at) != known.end()) continue;
      const double evidence = evidence_for(*at, -kLogPlaces);
      const double log_odds = weigh(place, at->refined.T_map_lidar, evidence);
      if (evidence > 0 && log_odds > log_odds_) {
        likeliest_ = static_cast<std::size_t>(at - found.data());
        log_odds_ = log_odds;
      }
    }
    known[kept] = at;
    places_[kept++] = place;
  }
  count_ = kept;
  log_odds_ -= log_odds_of_unseen;
  for (const VerifiedHypothesis& place : found) {
    const double evidence = evidence_for(place, -kLogPlaces);
    if (count_ == kMaxPlaces || evidence < 0) return;
    if (std::find(known.begin(), known.end(), &place) != known.end()) continue;
    const Pose2& T_map_lidar = place.refined.T_map_lidar;
    places_[count_++] = {T_map_lidar, T_map_lidar, evidence_for(place, 0) - evidence, evidence,
                         false};
  }
}

}  // namespace cornerd::core
