// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/estimate/constant_velocity_model.hpp"
#include "core/pose_estimate.hpp"
#include "core/recognition/place_filter.hpp"
#include "core/recognition/place_search.hpp"

namespace cornerd::core {

/// A scan may name the wrong one of several places so often, by its own account: the places of an
/// answer hold the truth but for this share of belief.
inline constexpr double kWrongFixRate = 1e-5;

struct Decision {
  PoseState state = PoseState::kLost;
  std::size_t place = 0;   ///< index of the chosen place, in the states fix and tracking
  std::size_t rivals = 0;  ///< how many of the first places hold all that are in doubt
  /// Probability that the likeliest place is not the right one: what the odds leave to others, of a
  /// named one calibrated (src/bench/poses.md, "Reliability of the posterior").
  double doubt = 0;
};

/// Names the fewest places of PlaceSearch, the likeliest first, that leave out no more than
/// kWrongFixRate of the scan's belief: one of them is a fix, several are ambiguous. That the scan
/// was taken somewhere else, or not in this map, is a hypothesis of its own. Where PlaceSearch
/// left out places (not `is_complete`) the scan alone names none, and without a prior the filter
/// begins again. `prior`: where the robot should be by what was known before. What the last scans
/// showed is in the filter, which it updates.
Decision decide(std::span<const VerifiedHypothesis> places, bool is_complete,
                const std::optional<Prior>& prior, PlaceFilter& filter);

/// True for a place that leaves no doubt that the scan was taken in this map.
bool is_in_map(const VerifiedHypothesis& place);

}  // namespace cornerd::core
