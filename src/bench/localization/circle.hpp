// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/map/wall_map.hpp"
#include "replay/simulator/motion.hpp"

namespace cornerd::bench {

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
