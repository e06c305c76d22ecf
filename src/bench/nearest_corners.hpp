// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "core/breakpoint/breakpoint.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// The paper's position (section V.F): from the two corners nearest to the sensor alone. It prints
/// no formula; here it is the rigid motion that puts the two on the map's corners, what is left of
/// their distance shared by both.
///
/// Recognition is not what is measured: a detection stands for the map's corner within 6 cm of it
/// as seen from the true place, and one without such a corner is passed over. So is a second one
/// less than 10 cm from the first, as the paper takes both corners of a wall's end for one point.
/// nullopt where fewer than two are left.
std::optional<core::Pose2> pose_from_nearest_corners(std::span<const core::Breakpoint> breakpoints,
                                                     const core::WallMap& map,
                                                     const core::Pose2& T_map_lidar);

}  // namespace cornerd::bench
