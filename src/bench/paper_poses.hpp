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
  std::size_t map = 0;       ///< which of the layouts
  core::Pose2 T_map_lidar;
};

/// The paper's 43 places, which it gives by number and room alone. Ours follow a rule: in each room
/// the first free points, 15 cm from any wall, of an evenly filling sequence (Roberts's R2 over the
/// room's bounding box), any heading, the layouts taking turns.
/// Throws std::runtime_error where a map lacks one of the rooms or has no place in it.
std::vector<PaperPose> paper_poses(std::span<const std::shared_ptr<const core::WallMap>> maps);

}  // namespace cornerd::bench
