// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/map/wall_map.hpp"
#include "survey/evidence.hpp"
#include "survey/wall_piece.hpp"
#include "survey/wall_solids.hpp"

namespace cornerd::survey {

/// What a drive says of a wall is believed within these.
struct WallLimits {
  PieceLimits pieces;
  SolidLimits solids;
};

struct BuiltWalls {
  std::vector<WallPiece> pieces;  ///< what the walls are made of
  std::vector<core::Wall> walls;
};

/// From the faces of an adjusted drive to walls: cut where rays went through, parted where they
/// cross, joined in corners, and those with two sides made solid. `dropped`: what became none is
/// added.
BuiltWalls build_walls_of(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                          const WallLimits& limits, std::vector<Dropped>& dropped);

}  // namespace cornerd::survey
