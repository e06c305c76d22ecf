// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::bench {

struct PaperPose {
  std::size_t location = 0;  ///< index into kPaperLocations
  std::size_t map = 0;       ///< index of the layout
  core::Pose2 T_map_lidar;
};

/// The paper's 43 poses, of which it prints only the number in each room. Here: the first free
/// points, 15 cm from any wall, of Roberts's R2 sequence over the room's bounding box, with a
/// random heading; the layouts alternate. Throws std::runtime_error where a map lacks a room or a
/// free point in it.
std::vector<PaperPose> paper_poses(std::span<const std::shared_ptr<const core::WallMap>> maps);

}  // namespace cornerd::bench
