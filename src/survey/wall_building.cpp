// SPDX-License-Identifier: MIT
#include "survey/wall_building.hpp"

namespace cornerd::survey {

BuiltWalls build_walls_of(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                          const WallLimits& limits, std::vector<Dropped>& dropped) {
  BuiltWalls built;
  built.pieces = cut_pieces(drive, evidence, limits.pieces, dropped);
  part_crossings(drive, limits.pieces, built.pieces, dropped);
  join_corners(drive, evidence, limits.pieces, built.pieces);
  drop_lonely(drive, limits.pieces, built.pieces, dropped);
  built.walls = build_walls(drive, built.pieces, pair_sides(drive, built.pieces, limits.solids));
  return built;
}

}  // namespace cornerd::survey
