// SPDX-License-Identifier: MIT
#include "core/recognition/decision.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Places are named as rivals where the scan was taken in this map but for this share of belief.
constexpr double kMaxElsewhere = 0.01;
/// No scan shows more (src/bench/poses.md).
constexpr double kLeastDoubtOfNamed = 1e-6;
/// A place that was left out is as likely as the best.
constexpr double kDoubtOfIncomplete = 0.5;

/// Rays are not independent: of fixes of which the odds leave p, about sqrt(p) are wrong.
double doubt_of_named(double by_odds) { return std::max(std::sqrt(by_odds), kLeastDoubtOfNamed); }

}  // namespace

Decision decide(std::span<const VerifiedHypothesis> places, bool is_complete,
                const std::optional<Prior>& prior, PlaceFilter& filter) {
  Decision decision;
  decision.doubt = 1;
  if (!is_complete && !prior) filter.forget();
  if (places.empty()) return decision;
  // Relative to the likeliest place; "elsewhere" has log odds 0.
  const double best = places.front().log_odds;
  const double elsewhere = std::exp(-best);
  double of_others = 0;
  for (std::size_t i = places.size(); i-- > 1;) {
    of_others += std::exp(places[i].log_odds - best);
    if (decision.rivals == 0 && of_others > kWrongFixRate) decision.rivals = i + 1;
  }
  decision.rivals = std::max<std::size_t>(decision.rivals, 1);
  const double of_rest = of_others + elsewhere;
  decision.doubt = of_rest / (1 + of_rest);
  if (of_rest < kWrongFixRate && is_complete && places.front().refined.is_held()) {
    decision.state = PoseState::kFix;
    decision.doubt = doubt_of_named(decision.doubt);
  } else if (elsewhere < kMaxElsewhere) {
    decision.state = PoseState::kAmbiguous;
    decision.doubt = std::max(decision.doubt, is_complete ? kLeastDoubt : kDoubtOfIncomplete);
  }
  filter.update(places, prior);
  if (filter.likeliest() && filter.doubt() < kWrongFixRate && decision.state != PoseState::kFix) {
    decision.place = *filter.likeliest();
    decision.state = PoseState::kTracking;
    decision.doubt = doubt_of_named(filter.doubt());
  }
  return decision;
}

bool is_in_map(const VerifiedHypothesis& place) {
  return place.log_odds > -std::log(kWrongFixRate);
}

}  // namespace cornerd::core
