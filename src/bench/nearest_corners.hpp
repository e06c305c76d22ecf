// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "core/breakpoint/breakpoint.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// Pose from the two corners nearest to the sensor (paper, section V.F). The paper prints no
/// formula: here it is the rigid transform of the two onto the map's corners, the residual of their
/// distance shared by both. Correspondences come from the true pose `T_map_lidar`, within 6 cm. A
/// second corner within 10 cm of the first is ignored, since the paper counts both corners of a
/// wall's end as one point. nullopt where fewer than two are left.
std::optional<core::Pose2> pose_from_nearest_corners(std::span<const core::Breakpoint> breakpoints,
                                                     const core::WallMap& map,
                                                     const core::Pose2& T_map_lidar);

}  // namespace cornerd::bench
