// SPDX-License-Identifier: MIT
#include "survey/doubled_walls.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// Walls of which every centimetre was hit, as they are seen from the origin.
double doubled_m(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  MappedDrive drive;
  std::vector<FaceEvidence> evidence;
  std::vector<WallPiece> pieces;
  for (const auto& [from, to] : walls) {
    const MappedFace face = face_between(from, to);
    FaceEvidence seen(face);
    for (double along_m = face.begin_m(); along_m < face.end_m(); along_m += 0.001) {
      seen.add_hit(along_m);
    }
    WallPiece piece;
    piece.face = static_cast<std::uint32_t>(drive.faces.size());
    piece.begin_m = face.begin_m();
    piece.end_m = face.end_m();
    drive.faces.push_back(face);
    evidence.push_back(seen);
    pieces.push_back(piece);
  }
  return doubled_walls_m(drive, evidence, pieces);
}

TEST(DoubledWalls, WallBehindAnother_IsDoubledButForItsEnds) {
  EXPECT_NEAR(doubled_m({{{2, 1}, {-2, 1}}, {{2, 1.1}, {-2, 1.1}}}), 4 - 2 * 0.3, 0.05);
}

TEST(DoubledWalls, WallTurnedByAFewDegrees_IsDoubledWhereItIsBehind) {
  EXPECT_GT(doubled_m({{{2, 1}, {-2, 1}}, {{2, 1.3}, {-2, 0.9}}}), 1);
}

TEST(DoubledWalls, WallBesideAnother_IsNot) {
  EXPECT_EQ(doubled_m({{{2, 1}, {0.5, 1}}, {{0.5, 1.1}, {-2, 1.1}}}), 0);
}

TEST(DoubledWalls, WavyWall_IsOne) {
  EXPECT_EQ(doubled_m({{{2, 1}, {-2, 1}}, {{2, 1.04}, {-2, 1.04}}}), 0);
}

TEST(DoubledWalls, RoomBehindTheWall_IsNot) {
  EXPECT_EQ(doubled_m({{{2, 1}, {-2, 1}}, {{2, 2}, {-2, 2}}}), 0);
}

TEST(DoubledWalls, OtherSideOfTheWall_IsNot) {
  EXPECT_EQ(doubled_m({{{2, 1}, {-2, 1}}, {{-2, 1.1}, {2, 1.1}}}), 0);
}

}  // namespace
}  // namespace cornerd::survey
