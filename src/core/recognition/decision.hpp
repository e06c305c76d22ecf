// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/estimate/constant_velocity_model.hpp"
#include "core/pose_estimate.hpp"
#include "core/recognition/place_filter.hpp"
#include "core/recognition/verification.hpp"

namespace cornerd::core {

/// A turn may name the wrong one of several places so often, by its own account: the places of an
/// answer hold the truth but for this share of belief.
inline constexpr double kWrongFixRate = 1e-5;

struct Decision {
  PoseState state = PoseState::kLost;
  std::size_t place = 0;   ///< index of the chosen place, in the states fix and tracking
  std::size_t rivals = 0;  ///< how many of the first places hold all that are in doubt
  double doubt = 0;        ///< belief that the likeliest place is not the right one
};

/// Names the fewest places, in the order of their likelihood, that leave out no more than
/// kWrongFixRate of the turn's belief: one of them is a fix, several are ambiguous. `places`: the
/// likeliest first. `prior`: where the robot should be by what was known before; it may choose
/// among rivals where the robot can have come to no other one, never against the turn. `open`:
/// other places, whose poses the turn leaves open.
Decision decide(std::span<const VerifiedHypothesis> places, const std::optional<Prior>& prior,
                std::span<const VerifiedHypothesis> open = {});

/// The same for places of PlaceSearch, in a map that is inexact and incomplete. That the scan was
/// taken somewhere else, or not in this map, is a hypothesis of its own. What the last scans showed
/// is in the filter, which it updates.
Decision decide_by_faces(std::span<const VerifiedHypothesis> places,
                         const std::optional<Prior>& prior, PlaceFilter& filter);

/// True for a place of PlaceSearch that leaves no doubt that the scan was taken in this map.
bool is_in_map(const VerifiedHypothesis& place);

/// How much the turn believes in a place next to the likeliest one: 1 for that one itself.
double relative_belief(const VerifiedHypothesis& place, const VerifiedHypothesis& likeliest);

}  // namespace cornerd::core
