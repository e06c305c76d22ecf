// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/map/wall_map.hpp"

namespace cornerd::replay {

/// A room of 2 by 3 m with its lower left corner at the origin.
inline std::shared_ptr<const core::WallMap> make_room() {
  core::FloorPlan plan;
  plan.name = "room";
  plan.walls = {{{0, 0}, {2, 0}, 0}, {{2, 0}, {2, 3}, 0}, {{2, 3}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}};
  return std::make_shared<const core::WallMap>(plan);
}

/// Two rooms of 2 x 2 m, a wall of 0.1 m between them, a door of 0.6 m in it.
inline core::WallMap two_rooms() {
  core::FloorPlan plan;
  plan.walls = {{{0, 0}, {4, 0}, 0.1}, {{4, 0}, {4, 2}, 0.1},   {{4, 2}, {0, 2}, 0.1},
                {{0, 2}, {0, 0}, 0.1}, {{2, 0}, {2, 0.7}, 0.1}, {{2, 1.4}, {2, 2}, 0.1}};
  return core::WallMap(plan);
}

}  // namespace cornerd::replay
