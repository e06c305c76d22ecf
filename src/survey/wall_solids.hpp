// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/map/wall_map.hpp"
#include "survey/adjustment.hpp"
#include "survey/wall_piece.hpp"

namespace cornerd::survey {

/// Two pieces that are the two sides of one wall.
struct WallPair {
  std::uint32_t one = 0;  ///< pieces; `one` runs along the wall's own direction
  std::uint32_t other = 0;
  double thickness_m = 0;
  double begin_m = 0;  ///< where both are there, along the face of `one`
  double end_m = 0;
};

struct SolidLimits {
  double thickness_m = 0.6;  ///< what is thicker is no wall, but a room that nobody entered
  double rotation_rad = core::radians(2);  ///< between both sides
};

/// Sides that stand back to back, the thinnest walls first.
std::vector<WallPair> pair_sides(const MappedDrive& drive, std::span<const WallPiece> pieces,
                                 const SolidLimits& limits);

/// That both sides of a wall are parallel, as far as their sightings allow.
std::vector<FaceBond> bonds_of(const MappedDrive& drive, std::span<const WallPiece> pieces,
                               std::span<const WallPair> pairs);

/// The walls of the map: solids where both sides were seen, lines where one was.
std::vector<core::Wall> build_walls(const MappedDrive& drive, std::span<const WallPiece> pieces,
                                    std::span<const WallPair> pairs);

}  // namespace cornerd::survey
