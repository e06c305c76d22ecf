// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::replay {

/// Doors of a plan: gaps of 0.3 to 1.2 m between a wall's end and the next wall in its direction.
std::vector<core::Wall> doors_of(const core::WallMap& map);

}  // namespace cornerd::replay
