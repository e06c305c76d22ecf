// SPDX-License-Identifier: MIT
#include "survey/wall_building.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

struct Pieces {
  MappedDrive drive;
  std::vector<WallPiece> pieces;
};

Pieces pieces_of(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  Pieces result;
  for (const auto& [from, to] : walls) {
    const LineLandmark face = face_between(from, to);
    WallPiece piece;
    piece.face = static_cast<std::uint32_t>(result.drive.faces.size());
    piece.begin_m = face.begin_m();
    piece.end_m = face.end_m();
    piece.begin.point = from;
    piece.end.point = to;
    result.drive.faces.push_back(face);
    result.pieces.push_back(piece);
  }
  return result;
}

TEST(PairSides, FacesBackToBack_AreOneWall) {
  const Pieces walls = pieces_of({{{3, 2}, {0, 2}}, {{0.5, 2.12}, {3, 2.12}}});
  const auto pairs = pair_sides(walls.drive, walls.pieces, {});
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].thickness_m, 0.12, 1e-9);
  EXPECT_NEAR(pairs[0].end_m - pairs[0].begin_m, 2.5, 1e-9);
}

TEST(PairSides, FacesTowardsEachOther_AreNotPaired) {
  const Pieces walls = pieces_of({{{0, 2}, {3, 2}}, {{3, 2.12}, {0, 2.12}}});
  EXPECT_TRUE(pair_sides(walls.drive, walls.pieces, {}).empty());
}

TEST(PairSides, ThickerThanLimit_IsNotPaired) {
  const Pieces walls = pieces_of({{{3, 2}, {0, 2}}, {{0, 3}, {3, 3}}});
  EXPECT_TRUE(pair_sides(walls.drive, walls.pieces, {}).empty());
}

TEST(PairSides, TwoBacks_ShareTheFrontFace) {
  // A wall with its back 0.1 m behind for half of its length, and a block 0.4 m behind for the
  // rest.
  const Pieces walls =
      pieces_of({{{3, 2}, {0, 2}}, {{0, 2.1}, {1.5, 2.1}}, {{1.5, 2.4}, {3, 2.4}}});
  const auto pairs = pair_sides(walls.drive, walls.pieces, {});
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(pairs[0].thickness_m, 0.1, 1e-9);
  EXPECT_NEAR(pairs[1].thickness_m, 0.4, 1e-9);
}

TEST(BuildWalls, PairedFaces_GiveSolidWithSquareEnds) {
  const Pieces walls = pieces_of({{{3, 2}, {0, 2}}, {{0, 2.12}, {3, 2.12}}});
  const auto pairs = pair_sides(walls.drive, walls.pieces, {});
  const auto built = build_walls(walls.drive, walls.pieces, pairs);
  ASSERT_EQ(built.size(), 1U);
  EXPECT_NEAR(built[0].thickness_m, 0.12, 1e-9);
  EXPECT_NEAR(std::max(built[0].from.x(), built[0].to.x()), 2.94, 1e-9);
  EXPECT_NEAR(std::min(built[0].from.x(), built[0].to.x()), 0.06, 1e-9);
  EXPECT_NEAR(built[0].from.y(), 2.06, 1e-9);
}

TEST(BuildWalls, EndFace_ClosesSolid) {
  Pieces walls =
      pieces_of({{{3, 2}, {0, 2}}, {{0.01, 2.12}, {3, 2.12}}, {{0.015, 2}, {0.015, 2.12}}});
  walls.pieces[0].end.neighbour = 2;
  walls.pieces[2].begin.neighbour = 0;
  walls.pieces[2].end.neighbour = 1;
  walls.pieces[1].begin.neighbour = 2;
  const auto pairs = pair_sides(walls.drive, walls.pieces, {});
  const auto built = build_walls(walls.drive, walls.pieces, pairs);
  ASSERT_EQ(built.size(), 1U);
  EXPECT_NEAR(std::min(built[0].from.x(), built[0].to.x()), 0.075, 1e-9);
}

TEST(BuildWalls, SingleFace_IsLine) {
  const Pieces walls = pieces_of({{{3, 2}, {0, 2}}});
  const auto built = build_walls(walls.drive, walls.pieces, {});
  ASSERT_EQ(built.size(), 1U);
  EXPECT_EQ(built[0].thickness_m, 0);
  EXPECT_NEAR((built[0].from - Vec2(3, 2)).norm(), 0, 1e-9);
}

TEST(BuildWalls, LongerFace_ContinuesAsLine) {
  const Pieces walls = pieces_of({{{3, 2}, {0, 2}}, {{0, 2.12}, {1.5, 2.12}}});
  const auto pairs = pair_sides(walls.drive, walls.pieces, {});
  const auto built = build_walls(walls.drive, walls.pieces, pairs);
  ASSERT_EQ(built.size(), 2U);
  EXPECT_EQ(built[1].thickness_m, 0);
  EXPECT_NEAR((built[1].to - built[1].from).norm(), 1.5, 0.01);
}

TEST(BuildWalls, BlockThickerThanLong_IsWallAcross) {
  const Pieces walls = pieces_of({{{0.2, 2}, {0, 2}}, {{0, 2.5}, {0.2, 2.5}}});
  const auto pairs = pair_sides(walls.drive, walls.pieces, {});
  const auto built = build_walls(walls.drive, walls.pieces, pairs);
  ASSERT_EQ(built.size(), 1U);
  EXPECT_NEAR(built[0].thickness_m, 0.2, 1e-9);
  EXPECT_NEAR((built[0].to - built[0].from).norm(), 0.3, 1e-9);
}

TEST(BuildWalls, EndWhereSightEnded_IsOpen) {
  Pieces walls = pieces_of({{{3, 2}, {0, 2}}, {{0.5, 2.12}, {3, 2.12}}, {{0, 0}, {2, 0}}});
  walls.pieces[0].begin.is_open = true;  // of both faces, at x = 3
  walls.pieces[1].end.is_open = true;
  walls.pieces[1].begin.is_open = true;  // of the back alone, where the front goes on
  walls.pieces[2].end.is_open = true;
  const auto built =
      build_walls(walls.drive, walls.pieces, pair_sides(walls.drive, walls.pieces, {}));
  ASSERT_EQ(built.size(), 3U);
  EXPECT_NEAR(built[0].thickness_m, 0.12, 1e-9);
  EXPECT_EQ(built[0].is_open, (std::array<bool, 2>{true, true}));
  EXPECT_EQ(built[1].is_open, (std::array<bool, 2>{false, false}));
  EXPECT_EQ(built[2].is_open, (std::array<bool, 2>{false, true}));
}

}  // namespace
}  // namespace cornerd::survey
