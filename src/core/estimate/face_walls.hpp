// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Which wall a face is the long side of.
struct FaceWall {
  std::uint32_t wall = 0;  ///< index into FloorPlan::walls
  /// Of the face's normal along rotate_left(direction of the wall): 1, -1; 0: the end of a wall.
  double sign = 0;
};

/// Of each face of the map.
std::vector<FaceWall> face_walls(const WallMap& map);

}  // namespace cornerd::core
