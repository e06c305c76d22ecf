// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/localizer.hpp"
#include "core/recognition/verification.hpp"

namespace cornerd::core {

struct Decision {
  PoseState state = PoseState::kLost;
  std::size_t place = 0;   ///< index of the chosen place, in the states fix and tracking
  std::size_t rivals = 0;  ///< how many of the first places hold all that are in doubt
};

/// Names one place only where the turn does. `places`: the likeliest first. `prior`: where the
/// robot should be by what was known before; it may choose among rivals, never against the turn.
Decision decide(std::span<const Place> places, const std::optional<Pose2>& prior);

/// How much a place is believed next to the likeliest one: 1 for that one itself.
double relative_belief(const Place& place, const Place& likeliest);

}  // namespace cornerd::core
