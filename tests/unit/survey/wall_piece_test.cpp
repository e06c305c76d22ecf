// SPDX-License-Identifier: MIT
#include "survey/wall_piece.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

struct Scene {
  MappedDrive drive;
  std::vector<FaceEvidence> evidence;
  std::vector<WallPiece> pieces;
  std::vector<DroppedPiece> dropped;
};

Scene cut(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  Scene scene;
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i < 20; ++i) trajectory.push_back({0.1 * i, 0, 0});
  scene.drive = mapped_drive(walls, trajectory);
  add_returns(scene.drive);
  scene.evidence = gather_evidence(scene.drive, {}, {});
  scene.pieces = cut_pieces(scene.drive, scene.evidence, {}, scene.dropped);
  return scene;
}

TEST(CutPieces, FaceAcrossDoorway_BecomesTwoPieces) {
  Scene scene = cut({{{3, 2}, {2, 2}}, {{1, 2}, {-1, 2}}, {{5, 4}, {-3, 4}}});
  // Both pieces as one face.
  scene.drive.faces[0].extend({-1, 2});
  scene.drive.faces.erase(scene.drive.faces.begin() + 1);
  scene.drive.observations.clear();
  scene.evidence = gather_evidence(scene.drive, {}, {});
  scene.pieces = cut_pieces(scene.drive, scene.evidence, {}, scene.dropped);
  std::vector<double> lengths_m;
  for (const WallPiece& piece : scene.pieces) {
    if (piece.face == 0) lengths_m.push_back(piece.length_m());
  }
  ASSERT_EQ(lengths_m.size(), 2U);
  EXPECT_NEAR(lengths_m[0], 1, 0.05);
  EXPECT_NEAR(lengths_m[1], 2, 0.05);
}

TEST(CutPieces, FaceWithPassingRays_IsDroppedWithReason) {
  Scene scene = cut({{{5, 4}, {-3, 4}}});
  scene.drive.faces.push_back(face_between({1.5, 2}, {0.5, 2}));  // somebody stood there
  scene.evidence = gather_evidence(scene.drive, {}, {});
  scene.dropped.clear();
  scene.pieces = cut_pieces(scene.drive, scene.evidence, {}, scene.dropped);
  ASSERT_EQ(scene.dropped.size(), 1U);
  EXPECT_NE(scene.dropped[0].why.find("rays went through"), std::string::npos);
}

TEST(CutPieces, FaceObservedInFewScans_IsDroppedWithReason) {
  Scene scene = cut({{{5, 4}, {-3, 4}}});
  scene.drive.faces[0].observations = 4;
  scene.pieces = cut_pieces(scene.drive, scene.evidence, {}, scene.dropped);
  EXPECT_TRUE(scene.pieces.empty());
  ASSERT_EQ(scene.dropped.size(), 1U);
  EXPECT_EQ(scene.dropped[0].why, "observed in 4 scans");
}

TEST(MarkOpenEnds, EndBesideWhichRaysPassed_IsNotOpen) {
  // Rays pass beside the right end, x = 1, to the wall behind. Beyond the left one is nothing.
  Scene scene = cut({{{1, 2}, {-1, 2}}, {{5, 4}, {1, 4}}});
  mark_open_ends(scene.evidence, scene.pieces);
  ASSERT_FALSE(scene.pieces.empty());
  ASSERT_EQ(scene.pieces[0].face, 0U);
  EXPECT_FALSE(scene.pieces[0].begin.is_open);
  EXPECT_TRUE(scene.pieces[0].end.is_open);
}

WallPiece piece_of(MappedDrive& drive, const Vec2& from, const Vec2& to, std::size_t hits) {
  const LineLandmark face = face_between(from, to);
  WallPiece piece;
  piece.face = static_cast<std::uint32_t>(drive.faces.size());
  piece.begin_m = face.begin_m();
  piece.end_m = face.end_m();
  piece.hits = hits;
  drive.faces.push_back(face);
  return piece;
}

TEST(TrimCrossings, CrossingWall_EndsAtFrontOfOther) {
  MappedDrive drive;
  // Free space is below the first; the second comes from there and crosses it.
  std::vector<WallPiece> pieces = {piece_of(drive, {2, 1}, {-2, 1}, 900),
                                   piece_of(drive, {0, 0}, {0, 1.5}, 100)};
  std::vector<DroppedPiece> dropped;
  trim_crossings(drive, {}, pieces, dropped);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR((pieces[1].end.point - Vec2(0, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR((pieces[1].begin.point - Vec2(0, 0)).norm(), 0, 1e-9);
  EXPECT_TRUE(dropped.empty());
}

TEST(TrimCrossings, SmallAngle_IsDroppedWithReason) {
  MappedDrive drive;
  std::vector<WallPiece> pieces = {piece_of(drive, {1, 1.1}, {-1, 0.9}, 100),
                                   piece_of(drive, {2, 1}, {-2, 1}, 900)};
  std::vector<DroppedPiece> dropped;
  trim_crossings(drive, {}, pieces, dropped);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].hits, 900U);
  ASSERT_EQ(dropped.size(), 1U);
  EXPECT_EQ(dropped[0].why, "a wrong line along a wall");
}

TEST(TrimCrossings, OuterCorner_StaysUnchanged) {
  MappedDrive drive;
  // Both extend a cell beyond their corner.
  std::vector<WallPiece> pieces = {piece_of(drive, {2, 1}, {-0.02, 1}, 900),
                                   piece_of(drive, {0, 0.98}, {0, 2}, 100)};
  std::vector<DroppedPiece> dropped;
  trim_crossings(drive, {}, pieces, dropped);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(pieces[0].length_m(), 2.02, 1e-9);
  EXPECT_NEAR(pieces[1].length_m(), 1.02, 1e-9);
}

TEST(JoinCorners, RoomCorner_MeetsAtIntersection) {
  Scene scene = cut({{{-1, -1}, {3, -1}}, {{3, -1}, {3, 2}}});
  join_corners(scene.drive, scene.evidence, {}, scene.pieces);
  ASSERT_EQ(scene.pieces.size(), 2U);
  EXPECT_EQ(scene.pieces[0].end.neighbour, 1U);
  EXPECT_EQ(scene.pieces[1].begin.neighbour, 0U);
  EXPECT_TRUE(scene.pieces[0].end.is_concave);
  EXPECT_NEAR((scene.pieces[0].end.point - Vec2(3, -1)).norm(), 0, 1e-6);
  EXPECT_EQ(scene.pieces[0].begin.neighbour, kNoPiece);
}

TEST(JoinCorners, OuterCorner_IsConvex) {
  Scene scene = cut({{{1.9, 1.5}, {1, 1.5}}, {{1, 1.5}, {1, 1.9}}});
  ASSERT_EQ(scene.pieces.size(), 2U);
  join_corners(scene.drive, scene.evidence, {}, scene.pieces);
  EXPECT_EQ(scene.pieces[0].end.neighbour, 1U);
  EXPECT_FALSE(scene.pieces[0].end.is_concave);
}

TEST(JoinCorners, DoorwayBetweenWalls_AreNotJoined) {
  Scene scene =
      cut({{{3, 1}, {3, 2}}, {{2.75, 2.2}, {-1, 2.2}}, {{6, -2}, {6, 5}}, {{6, 5}, {-2, 5}}});
  join_corners(scene.drive, scene.evidence, {}, scene.pieces);
  EXPECT_EQ(scene.pieces[0].end.neighbour, kNoPiece) << "rays went through the corner";
}

TEST(JoinCorners, WallMeetsSideOfAnother_EndsThere) {
  Scene scene = cut({{{4, 2}, {-2, 2}}, {{1, 2}, {1, 1}}});
  join_corners(scene.drive, scene.evidence, {}, scene.pieces);
  ASSERT_EQ(scene.pieces.size(), 2U);
  EXPECT_EQ(scene.pieces[1].begin.neighbour, 0U);
  EXPECT_TRUE(scene.pieces[1].begin.within);
  EXPECT_EQ(scene.pieces[0].begin.neighbour, kNoPiece);
}

TEST(DropIsolated, ShortPiece_IsDroppedAndNeighboursAreRenumbered) {
  Scene scene = cut({{{0.5, 1}, {0.38, 1}}, {{-1, -1}, {3, -1}}, {{3, -1}, {3, 2}}});
  join_corners(scene.drive, scene.evidence, {}, scene.pieces);
  ASSERT_EQ(scene.pieces.size(), 3U);
  drop_isolated(scene.drive, {}, scene.pieces, scene.dropped);
  ASSERT_EQ(scene.pieces.size(), 2U);
  EXPECT_EQ(scene.pieces[0].end.neighbour, 1U);
  EXPECT_EQ(scene.dropped.back().why, "short and isolated");
}

}  // namespace
}  // namespace cornerd::survey
