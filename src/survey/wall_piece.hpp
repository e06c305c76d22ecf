// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "survey/drive_mapper.hpp"
#include "survey/face_evidence.hpp"

namespace cornerd::survey {

inline constexpr std::uint32_t kNoPiece = 0xffffffff;

/// One end of a piece of wall.
struct PieceEnd {
  core::Vec2 point = core::Vec2::Zero();
  std::uint32_t neighbour = kNoPiece;  ///< meets this piece in a corner
  bool is_concave = false;             ///< the free space's opening angle is less than pi
  bool within = false;                 ///< meets the neighbour's side, not its end
  double unseen_m = 0;                 ///< from the last hit to the corner
  bool is_open = false;                ///< sight ended here: no ray passed beside the end
};

/// A part of a wall face without an opening. Free space is on the left of the direction from
/// `begin` to `end`.
struct WallPiece {
  std::uint32_t face = 0;
  double begin_m = 0;  ///< along the face
  double end_m = 0;
  double seen_m = 0;  ///< length with hits
  std::size_t hits = 0;
  PieceEnd begin;
  PieceEnd end;
  double length_m() const { return end_m - begin_m; }
};

/// A part of a face that became no wall, and the reason.
struct DroppedPiece {
  core::Vec2 from;
  core::Vec2 to;
  std::string why;
};

struct PieceLimits {
  /// Largest part without hits inside a piece (a cupboard, the joint of another wall). No ray may
  /// have gone through it.
  double gap_m = 0.3;
  /// Shortest piece: the direction of a shorter one is unknown.
  double least_m = 0.05;
  /// Shortest piece without a neighbour.
  double isolated_m = 0.2;
  /// Smallest number of rays that ended on it, and of scans that observed it.
  std::size_t hits = 30;
  std::size_t observations = 5;
  /// Smallest share of its length with hits.
  double seen_share = 0.6;
  /// Largest extension from the last hit to a corner.
  double corner_m = 0.3;
};

/// Cuts the faces where rays went through, and drops pieces beyond the limits.
std::vector<WallPiece> cut_pieces(const MappedDrive& drive,
                                  const std::vector<FaceEvidence>& evidence,
                                  const PieceLimits& limits, std::vector<DroppedPiece>& dropped);

/// Of two pieces that cross, the one with fewer hits ends at the front of the other. At a small
/// angle it is a wrong line along the other, and is dropped.
void trim_crossings(const MappedDrive& drive, const PieceLimits& limits,
                    std::vector<WallPiece>& pieces, std::vector<DroppedPiece>& dropped);

/// Extends or shortens pieces to the corner of two, or to the side of another. No piece is extended
/// where rays went through.
void join_corners(const MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                  const PieceLimits& limits, std::vector<WallPiece>& pieces);

/// Marks the ends that meet no other piece and that no rays passed beside.
void mark_open_ends(const std::vector<FaceEvidence>& evidence, std::vector<WallPiece>& pieces);

/// Drops pieces without a neighbour that are too short.
void drop_isolated(const MappedDrive& drive, const PieceLimits& limits,
                   std::vector<WallPiece>& pieces, std::vector<DroppedPiece>& dropped);

}  // namespace cornerd::survey
