// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::replay {

/// Random poses of a robot inside a building, any heading: in one of the map's rooms or with walls
/// on all sides, in free space, and no wall nearer than `clearance_m`.
/// Throws std::runtime_error where the map has next to no such place.
std::vector<core::Pose2> random_poses(const core::WallMap& map, std::size_t count,
                                      double clearance_m, std::uint64_t seed);

/// True where a robot could stand: in free space, in one of the rooms or with walls on all sides.
bool is_indoors(const core::WallMap& map, const core::Vec2& point);

/// Distance from a point to the nearest wall surface; infinite for a map without any.
double clearance_at(const core::WallMap& map, const core::Vec2& point);

}  // namespace cornerd::replay
