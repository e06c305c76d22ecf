// SPDX-License-Identifier: MIT
// Worlds that differ from their map: unmapped obstacles, closed doors, displaced walls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/map/wall_map.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::bench {

/// An unmapped upright cylinder: a person, a bin.
struct RoundObstacle {
  core::Vec2 centre = core::Vec2::Zero();
  double radius_m = 0;
};

/// Distance along a ray to the nearest obstacle, at most `range_m`, metres. A `range_m` of 0 stands
/// for no return.
double range_with_obstacles(const std::vector<RoundObstacle>& obstacles, const core::Vec2& origin,
                            double angle_rad, double range_m);

/// Random obstacles around a point that stop at least `share` of its rays before the walls.
std::vector<RoundObstacle> clutter_around(const core::WallMap& map, const core::Vec2& place,
                                          double share, replay::Random& random);

/// One plan for each door, with that door closed.
std::vector<core::FloorPlan> with_a_door_closed(const core::WallMap& map);

/// One plan for each wall, with that wall moved along its normal.
std::vector<core::FloorPlan> with_a_wall_displaced(const core::WallMap& map, double by_m);

/// The mirror image: no scan of the building may be named in it.
core::FloorPlan mirrored(core::FloorPlan plan);

/// Motion on a circle to the left; at rest where the yaw rate is 0.
struct CircularMotion {
  double speed_m_s = 0;
  double yaw_rate_rad_s = 0;
};

/// Endless circular motion from `start`.
replay::Motion circling(const core::Pose2& start, const CircularMotion& motion);

/// Start poses of random circles with a clearance of 15 cm to the walls. Throws std::runtime_error
/// where the world has no room for them.
std::vector<core::Pose2> random_circles(const core::WallMap& world, const CircularMotion& motion,
                                        std::size_t count, std::uint64_t seed);

}  // namespace cornerd::bench
