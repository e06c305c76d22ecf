// SPDX-License-Identifier: MIT
// A building as it is, which is not always as its map has it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/map/wall_map.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::bench {

/// A obstacle that is not on the map, upright and round: a person, a bin.
struct RoundObstacle {
  core::Vec2 centre = core::Vec2::Zero();
  double radius_m = 0;
};

/// Distance along a ray to the nearest of `obstacles`, at most `range_m`; 0 where that is 0 and
/// none is met.
double range_with_obstacles(const std::vector<RoundObstacle>& obstacles, const core::Vec2& origin,
                            double angle_rad, double range_m);

/// Things around a place that stop at least `share` of its rays before the walls do.
std::vector<RoundObstacle> clutter_around(const core::WallMap& map, const core::Vec2& place,
                                          double share, replay::Random& random);

/// The doors of a plan: from a wall's end, straight on over 0.3 to 1.2 m of free floor to what is
/// next.
std::vector<core::Wall> doors_of(const core::WallMap& map);

/// The same building with one of its doors closed, in one plan each.
std::vector<core::FloorPlan> with_a_door_closed(const core::WallMap& map);

/// The same with one of its walls moved across itself, in one plan for each wall.
std::vector<core::FloorPlan> with_a_wall_displaced(const core::WallMap& map, double by_m);

/// How the robot moves: on a circle to the left, at these speeds; not at all where they are 0.
struct CircularMotion {
  double speed_m_s = 0;
  double yaw_rate_rad_s = 0;
};

/// From `start` on, for ever.
replay::Motion circling(const core::Pose2& start, const CircularMotion& motion);

/// Random circles that keep clear of the walls, by their first pose. Throws std::runtime_error
/// where the world has no room for them.
std::vector<core::Pose2> random_circles(const core::WallMap& world, const CircularMotion& motion,
                                        std::size_t count, std::uint64_t seed);

}  // namespace cornerd::bench
