// SPDX-License-Identifier: MIT
#include "survey/face_merging.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

MappedDrive with_walls(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i < 10; ++i) trajectory.push_back({0.2 * i, 0, 0});
  MappedDrive drive = mapped_drive(walls, trajectory);
  add_returns(drive);
  return drive;
}

TEST(FaceMerging, Merge_OverlappingFaces_BecomeOne) {
  MappedDrive drive = with_walls({{{3, 2}, {1, 2}}, {{1.5, 2.005}, {-1, 2.005}}});
  const std::size_t observations = drive.observations.size();
  EXPECT_EQ(merge_faces(drive, {}, {}), 1U);
  ASSERT_EQ(drive.faces.size(), 1U);
  EXPECT_NEAR(drive.faces[0].length_m(), 4, 0.01);
  EXPECT_EQ(drive.observations.size(), observations);
  for (const MatchedObservation& observation : drive.observations) EXPECT_EQ(observation.face, 0U);
}

TEST(FaceMerging, Merge_StepOf12cm_StaysTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {1, 2}}, {{1.5, 2.12}, {-1, 2.12}}});
  EXPECT_EQ(merge_faces(drive, {}, {}), 0U);
}

TEST(FaceMerging, Merge_OppositeFaces_StayTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {1, 2}}, {{1, 2.01}, {3, 2.01}}});
  EXPECT_EQ(merge_faces(drive, {}, {}), 0U);
}

TEST(FaceMerging, Merge_Duplicate6cmApart_BecomesOneByEvidence) {
  // Half of the scans see the same wall 6 cm farther off, as with wrong poses.
  MappedDrive drive = with_walls({{{3, 2}, {-1, 2}}});
  drive.faces.push_back(face_between({2.5, 2.06}, {-0.5, 2.06}));
  for (std::size_t scan = 5; scan < 10; ++scan) {
    for (std::size_t i = drive.first_point[scan]; i < drive.first_point[scan + 1]; ++i) {
      DeskewedPoint& point = drive.points[i];
      point.range_m *= 2.06F / 2.0F;
    }
  }
  EXPECT_EQ(merge_faces(drive, {}, {}), 0U) << "without the rays it might be a step";
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 1U);
}

TEST(FaceMerging, Merge_BoxInFrontOfWall_StaysTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {-1, 2}}, {{1.3, 1.94}, {0.7, 1.94}}});
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 0U) << "the box hides the wall behind it";
}

TEST(FaceMerging, Merge_WallOnBothSidesOfADoor_BecomesOne) {
  MappedDrive drive = with_walls({{{3, 2}, {1.5, 2}}, {{0.6, 2}, {-1, 2}}, {{6, 4}, {-4, 4}}});
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 1U);
}

TEST(FaceMerging, Merge_OnOneLineFartherApart_StaysTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {1.5, 2}}, {{0.2, 2}, {-1, 2}}, {{6, 4}, {-4, 4}}});
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 0U);
}

TEST(FaceMerging, Merge_SteppedBehindADoor_StaysTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {1.5, 2}}, {{0.6, 2.1}, {-1, 2.1}}, {{6, 4}, {-4, 4}}});
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 0U);
}

/// Along a wall of 12 m; another wall is in sight only from both ends of the trajectory.
MappedDrive drive_along_a_wall() {
  const std::vector<std::pair<core::Vec2, core::Vec2>> walls = {{{-1, -1}, {11, -1}},
                                                                {{2, 3}, {-1, 3}}};
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i <= 10; ++i) trajectory.push_back({1.0 * i, 0, 0});
  MappedDrive drive = mapped_drive(walls, trajectory);
  std::erase_if(drive.observations, [](const MatchedObservation& observation) {
    return observation.face == 1 && observation.scan > 1 && observation.scan < 9;
  });
  return drive;
}

TEST(SplitRevisited, FaceOutOfSightForLong_BecomesTwo) {
  MappedDrive drive = drive_along_a_wall();
  EXPECT_EQ(split_revisited(drive, 8, 5), 1U);
  ASSERT_EQ(drive.faces.size(), 3U);
  EXPECT_EQ(drive.faces[0].observations, 11U);
  EXPECT_EQ(drive.faces[1].observations, 2U);
  EXPECT_EQ(drive.faces[1].last_scan, 1U);
  EXPECT_EQ(drive.faces[2].observations, 2U);
  EXPECT_EQ(drive.faces[2].first_scan, 9U);
  for (const MatchedObservation& observation : drive.observations) {
    EXPECT_EQ(observation.face == 2, observation.scan >= 9 && observation.face != 0);
  }
}

TEST(SplitRevisited, InSightAgainBeforeFromScan_StaysOne) {
  MappedDrive drive = drive_along_a_wall();
  EXPECT_EQ(split_revisited(drive, 10, 5), 0U);
}

TEST(SplitRevisited, ShorterDistanceOutOfSight_StaysOne) {
  MappedDrive drive = drive_along_a_wall();
  EXPECT_EQ(split_revisited(drive, 8, 9), 0U);
}

}  // namespace
}  // namespace cornerd::survey
