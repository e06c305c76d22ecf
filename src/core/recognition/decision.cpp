// SPDX-License-Identifier: MIT
#include "core/recognition/decision.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Log-likelihoods count every ray as if it were independent. A displaced wall or a person moves
/// many rays at once, so that this much of a difference decides nothing yet.
constexpr double kMargin = 15;
/// Each ray that even the likeliest place does not explain says that the map or the model is off by
/// something, and widens the margin by this much.
constexpr double kMarginPerStranger = 0.25;
/// The margin where things are counted instead of rays.
constexpr double kMarginOfThings = 12;
constexpr double kMarginOfThingsPerRay = 0.06;
/// What one thing more may hide of the turn: a door, a person next to the robot.
constexpr double kOneThingShare = 0.25;
/// What things may hide of the turn in all, for a place that is only likely because of them.
constexpr double kMostThingsShare = 0.3;
/// A place that explains so many rays more than the likeliest one is a rival to it, however
/// roughly.
constexpr double kRaysForARival = 4;
/// More, where things stand around: some stand near walls.
constexpr double kRaysForARivalPerThing = 0.125;
/// Where the prior is good enough to choose among rivals.
constexpr double kPriorRadius_m = 0.25;
constexpr double kPriorAngle_rad = radians(20);

}  // namespace

Decision decide(std::span<const Place> places, const std::optional<Pose2>& prior) {
  Decision decision;
  if (places.empty()) return decision;
  const Explanation& likeliest = places.front().explanation;
  const auto rays = static_cast<double>(likeliest.rays);
  const auto strangers = static_cast<double>(likeliest.rays - likeliest.hits);
  // Where not even the likeliest place's walls are as exact as the model, its likelihood is not.
  const double misfit = std::max(1.0, places.front().refined.spread);
  const double margin_of_things = kMarginOfThings + kMarginOfThingsPerRay * rays;
  const double margin = misfit * (kMargin + kMarginPerStranger * strangers);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Explanation& other = places[i].explanation;
    const bool as_likely = other.log_likelihood > likeliest.log_likelihood - margin;
    const bool one_thing_apart =
        other.log_likelihood_of_things > likeliest.log_likelihood_of_things - margin_of_things &&
        static_cast<double>(other.shorts) <
            std::min(static_cast<double>(likeliest.shorts) + kOneThingShare * rays,
                     kMostThingsShare * rays);
    // Less exact, but nothing stands in its way: the sensor may be biased, or a wall displaced.
    const bool explains_more = static_cast<double>(other.hits + other.near) >
                               static_cast<double>(likeliest.hits + likeliest.near) +
                                   kRaysForARival +
                                   kRaysForARivalPerThing * static_cast<double>(likeliest.shorts);
    if (as_likely || one_thing_apart || explains_more) decision.rivals = i + 1;
  }
  if (decision.rivals == 1) {
    decision.state = PoseState::kFix;
    return decision;
  }
  decision.state = PoseState::kAmbiguous;
  if (!prior) return decision;
  std::size_t near = 0;
  for (std::size_t i = 0; i < decision.rivals; ++i) {
    if (!same_place(places[i].refined.T_map_lidar, *prior, kPriorRadius_m, kPriorAngle_rad))
      continue;
    decision.place = i;
    ++near;
  }
  if (near == 1) decision.state = PoseState::kTracking;
  return decision;
}

double relative_belief(const Place& place, const Place& likeliest) {
  const double behind = likeliest.explanation.log_likelihood - place.explanation.log_likelihood;
  return std::exp(-behind / kMargin);
}

}  // namespace cornerd::core
