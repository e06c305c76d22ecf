// SPDX-License-Identifier: MIT
#include "core/recognition/decision.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Log-likelihoods count every ray as if it were independent. A displaced wall or a person moves
/// many rays at once: so many nats of a turn are worth one nat of belief. What they promise is
/// measured (`cornerd-bench --localizer`, "kept promises").
constexpr double kNatsPerNat = 1.3;
/// Each ray that even the likeliest place does not explain says that the map or the model
/// is off by something.
constexpr double kNatsPerNatPerStranger = 0.0217;
/// The same where things are counted instead of rays: so many for the turn, and for each ray.
constexpr double kNatsPerNatOfThings = 1.04;
constexpr double kNatsPerNatOfThingsPerRay = 0.0052;
/// What one thing more may hide of the turn: a door, a person next to the robot.
constexpr double kOneThingShare = 0.25;
/// What things may hide of the turn in all, for a place that is only likely because of them.
constexpr double kMostThingsShare = 0.3;
/// Places are named as rivals where the scan was taken in this map but for this share of belief.
constexpr double kMaxElsewhere = 0.01;
/// A place that explains so many rays more than the likeliest one is a rival to it, however
/// roughly.
constexpr double kRaysForARival = 4;
/// More, where things stand around: some stand near walls.
constexpr double kRaysForARivalPerThing = 0.125;
/// How far from a prior that is exact a rival is out of reach.
constexpr double kPriorRadius_m = 0.25;
/// The same where only a few rays tell the place along a corridor.
constexpr double kWeakPriorRadius_m = 0.05;
constexpr double kPriorAngle_rad = radians(20);

bool is_near(const VerifiedHypothesis& place, const Prior& prior, double radius_m) {
  return same_pose(place.refined.T_map_lidar, prior.T_map_lidar, radius_m + prior.position_error_m,
                   kPriorAngle_rad + prior.heading_error_rad);
}

/// How much a turn believes in a place next to the likeliest one, by whichever of three models of
/// what a map does not know makes the most of it.
class Belief {
 public:
  explicit Belief(const VerifiedHypothesis& likeliest)
      : likeliest_(likeliest.likelihood),
        rays_(static_cast<double>(likeliest_.rays)),
        shorts_(static_cast<double>(likeliest_.shorts)),
        // Where not even the likeliest place's walls are as exact as the model, its likelihood is
        // not.
        worth_(std::max(1.0, likeliest.refined.reduced_chi_square) *
               (kNatsPerNat +
                kNatsPerNatPerStranger * static_cast<double>(likeliest_.rays - likeliest_.hits))),
        worth_of_things_(kNatsPerNatOfThings + kNatsPerNatOfThingsPerRay * rays_) {}

  /// 1 for the likeliest place itself.
  double in(const VerifiedHypothesis& place) const {
    const BeamLikelihood& other = place.likelihood;
    if (explains_more(other)) return 1;
    const double by_rays = (other.log_likelihood - likeliest_.log_likelihood) / worth_;
    if (!is_few_things(other)) return std::exp(by_rays);
    const double by_things =
        (other.log_likelihood_of_obstacles - likeliest_.log_likelihood_of_obstacles) /
        worth_of_things_;
    return std::exp(std::min(0.0, std::max(by_rays, by_things)));
  }

 private:
  bool is_few_things(const BeamLikelihood& other) const {
    return static_cast<double>(other.shorts) <
           std::min(shorts_ + kOneThingShare * rays_, kMostThingsShare * rays_);
  }
  /// Less exact, but nothing stands in its way: the sensor may be biased, or a wall displaced.
  bool explains_more(const BeamLikelihood& other) const {
    return static_cast<double>(other.hits + other.near_hits) >
           static_cast<double>(likeliest_.hits + likeliest_.near_hits) + kRaysForARival +
               kRaysForARivalPerThing * shorts_;
  }

  const BeamLikelihood& likeliest_;
  double rays_;
  double shorts_;
  double worth_;
  double worth_of_things_;
};

}  // namespace

Decision decide(std::span<const VerifiedHypothesis> places, const std::optional<Prior>& prior,
                std::span<const VerifiedHypothesis> open) {
  Decision decision;
  if (places.empty()) return decision;
  const Belief belief(places.front());
  double of_others = 0;
  for (std::size_t i = places.size(); i-- > 1;) {
    of_others += belief.in(places[i]);
    if (decision.rivals == 0 && of_others > kWrongFixRate) decision.rivals = i + 1;
  }
  decision.rivals = std::max<std::size_t>(decision.rivals, 1);
  for (const VerifiedHypothesis& place : open) of_others += belief.in(place);
  decision.doubt = of_others / (1 + of_others);
  const bool is_held = places.front().refined.is_held();
  if (of_others <= kWrongFixRate && is_held) {
    decision.state = PoseState::kFix;
    return decision;
  }
  decision.state = PoseState::kAmbiguous;
  if (!prior || (!is_held && prior->position_error_m > kWeakPriorRadius_m)) return decision;
  const double radius_m = is_held ? kPriorRadius_m : kWeakPriorRadius_m;
  const auto is_here = [&](const VerifiedHypothesis& place) {
    return is_near(place, *prior, radius_m);
  };
  std::size_t near = 0;
  for (std::size_t i = 0; i < decision.rivals; ++i) {
    if (!is_here(places[i])) continue;
    decision.place = i;
    ++near;
  }
  if (near == 1 && std::none_of(open.begin(), open.end(), is_here)) {
    decision.state = PoseState::kTracking;
  }
  return decision;
}

Decision decide_by_faces(std::span<const VerifiedHypothesis> places,
                         const std::optional<Prior>& prior, PlaceFilter& filter) {
  Decision decision;
  decision.doubt = 1;
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
  decision.doubt = 1 - 1 / (1 + of_others + elsewhere);
  if (of_others + elsewhere < kWrongFixRate) {
    decision.state = PoseState::kFix;
  } else if (elsewhere < kMaxElsewhere) {
    decision.state = PoseState::kAmbiguous;
  }
  filter.update(places, prior);
  if (filter.likeliest() && filter.doubt() < kWrongFixRate && decision.state != PoseState::kFix) {
    decision.place = *filter.likeliest();
    decision.state = PoseState::kTracking;
    decision.doubt = filter.doubt();
  }
  return decision;
}

bool is_in_map(const VerifiedHypothesis& place) {
  return place.log_odds > -std::log(kWrongFixRate);
}

double relative_belief(const VerifiedHypothesis& place, const VerifiedHypothesis& likeliest) {
  if (likeliest.log_odds != 0) return std::exp(place.log_odds - likeliest.log_odds);
  return Belief(likeliest).in(place);
}

}  // namespace cornerd::core
