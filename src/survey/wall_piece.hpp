// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "survey/drive_mapper.hpp"
#include "survey/evidence.hpp"

namespace cornerd::survey {

inline constexpr std::uint32_t kNoPiece = 0xffffffff;

/// One end of a piece of wall.
struct PieceEnd {
  core::Vec2 point = core::Vec2::Zero();
  std::uint32_t neighbour = kNoPiece;  ///< that it meets in a corner
  bool is_concave = false;             ///< the free space opens by less than pi
  bool within = false;                 ///< of the neighbour's length: no end of its own
  double unseen_m = 0;                 ///< from the last thing seen to the corner
};

/// A stretch of one side of a wall without a hole. Free space is on the left of the way from
/// `begin` to `end`.
struct WallPiece {
  std::uint32_t face = 0;
  double begin_m = 0;  ///< along the face
  double end_m = 0;
  double seen_m = 0;  ///< of its length
  std::size_t hits = 0;
  PieceEnd begin;
  PieceEnd end;
  double length_m() const { return end_m - begin_m; }
};

/// What did not become a wall, and why.
struct Dropped {
  core::Vec2 from;
  core::Vec2 to;
  std::string why;
};

struct PieceLimits {
  /// What may lie unseen between two stretches of one wall: a cupboard's side, the joint of another
  /// wall. No ray may have gone through.
  double gap_m = 0.3;
  /// Shorter than this no wall's direction is known.
  double least_m = 0.05;
  /// A wall that nothing adjoins has to be longer, or seen better.
  double lonely_m = 0.2;
  /// Rays that have to have ended on it, and turns that saw it.
  std::size_t hits = 30;
  std::size_t sightings = 5;
  /// Of a piece's length, what has to have been seen.
  double seen_share = 0.6;
  /// From what was seen of a wall to the corner that it makes with the next one.
  double corner_m = 0.3;
};

/// Cuts the faces where rays went through, and drops what was not seen well enough.
std::vector<WallPiece> cut_pieces(const MappedDrive& drive,
                                  const std::vector<FaceEvidence>& evidence,
                                  const PieceLimits& limits, std::vector<Dropped>& dropped);

/// Where one piece runs through another, the part behind the one that more rays ended on was never
/// seen; and one that runs through another at a small angle is a mistaken line along it.
void part_crossings(const MappedDrive& drive, const PieceLimits& limits,
                    std::vector<WallPiece>& pieces, std::vector<Dropped>& dropped);

/// Lets pieces end where they meet: in the corner of two, or on the side of a third. Nothing is
/// prolonged through what rays went through.
void join_corners(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                  const PieceLimits& limits, std::vector<WallPiece>& pieces);

/// Takes out what after joining stands alone and is too short to be believed.
void drop_lonely(const MappedDrive& drive, const PieceLimits& limits,
                 std::vector<WallPiece>& pieces, std::vector<Dropped>& dropped);

}  // namespace cornerd::survey
