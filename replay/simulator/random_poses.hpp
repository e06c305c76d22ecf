// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::replay {

/// Uniform random poses indoors, with no wall nearer than `clearance_m`. Throws std::runtime_error
/// if less than about 1e-4 of the map's bounding box qualifies.
std::vector<core::Pose2> random_poses(const core::WallMap& map, std::size_t count,
                                      double clearance_m, std::uint64_t seed);

/// In free space, and in one of the map's rooms or with walls on all sides.
bool is_indoors(const core::WallMap& map, const core::Vec2& point);

/// Distance to the nearest wall surface; infinite for a map without walls.
double clearance_at(const core::WallMap& map, const core::Vec2& point);

}  // namespace cornerd::replay
