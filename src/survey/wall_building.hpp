// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/map/wall_map.hpp"
#include "survey/adjustment.hpp"
#include "survey/face_evidence.hpp"
#include "survey/wall_piece.hpp"

namespace cornerd::survey {

/// Two pieces that are the two faces of one wall.
struct WallPair {
  std::uint32_t one = 0;  ///< piece indices; `one` gives the wall's direction
  std::uint32_t other = 0;
  double thickness_m = 0;
  double begin_m = 0;  ///< overlap of both, along the face of `one`
  double end_m = 0;
};

struct SolidLimits {
  double thickness_m = 0.6;  ///< largest thickness; beyond it is a room that was not entered
  double rotation_rad = core::radians(2);  ///< between both faces
};

/// Pairs of faces back to back, the thinnest first.
std::vector<WallPair> pair_sides(const MappedDrive& drive, std::span<const WallPiece> pieces,
                                 const SolidLimits& limits);

/// Constraints that make both faces of a wall parallel, where they are so within their sigmas.
std::vector<FaceConstraint> parallel_constraints(const MappedDrive& drive,
                                                 std::span<const WallPiece> pieces,
                                                 std::span<const WallPair> pairs);

/// The walls of the map: with thickness where both faces were observed, else lines.
std::vector<core::Wall> build_walls(const MappedDrive& drive, std::span<const WallPiece> pieces,
                                    std::span<const WallPair> pairs);

struct WallLimits {
  PieceLimits pieces;
  SolidLimits solids;
};

struct BuiltWalls {
  std::vector<WallPiece> pieces;
  std::vector<core::Wall> walls;
};

/// Walls from the faces of an adjusted drive: cuts faces where rays went through, trims crossings,
/// joins corners and pairs faces. Appends to `dropped` what became no wall.
BuiltWalls build_walls_of(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                          const WallLimits& limits, std::vector<DroppedPiece>& dropped);

}  // namespace cornerd::survey
