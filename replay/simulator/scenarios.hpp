// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"

namespace cornerd::replay {

/// A drive through config/maps/flat-7.json that has a name.
struct Scenario {
  std::string_view name;
  std::vector<core::Vec2> path;  ///< from point to point, and back to the first
};

/// After Bertocco et al. (2019), whose flat and paths are known by small pictures alone: a short
/// circuit with two sharp turns, a longer one of right angles, and a full exploration.
std::span<const Scenario> scenarios();
/// nullptr where there is none of this name.
const Scenario* find_scenario(std::string_view name);

}  // namespace cornerd::replay
