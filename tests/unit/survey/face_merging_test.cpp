// SPDX-License-Identifier: MIT
#include "survey/face_merging.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

MappedDrive with_walls(const std::vector<std::pair<Vec2, Vec2>>& walls) {
  std::vector<core::Pose2> way;
  for (int i = 0; i < 10; ++i) way.push_back({0.2 * i, 0, 0});
  MappedDrive drive = mapped_drive(walls, way);
  add_returns(drive);
  return drive;
}

TEST(FaceMerging, Merge_WallSeenTwice_IsOne) {
  MappedDrive drive = with_walls({{{3, 2}, {1, 2}}, {{1.5, 2.005}, {-1, 2.005}}});
  const std::size_t observations = drive.observations.size();
  EXPECT_EQ(merge_faces(drive, {}, {}), 1U);
  ASSERT_EQ(drive.faces.size(), 1U);
  EXPECT_NEAR(drive.faces[0].length_m(), 4, 0.01);
  EXPECT_EQ(drive.observations.size(), observations);
  for (const Observation& observation : drive.observations) EXPECT_EQ(observation.face, 0U);
}

TEST(FaceMerging, Merge_StepBetweenTwoWalls_StaysAStep) {
  MappedDrive drive = with_walls({{{3, 2}, {1, 2}}, {{1.5, 2.12}, {-1, 2.12}}});
  EXPECT_EQ(merge_faces(drive, {}, {}), 0U);
}

TEST(FaceMerging, Merge_BothSidesOfAWall_StayTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {1, 2}}, {{1, 2.01}, {3, 2.01}}});
  EXPECT_EQ(merge_faces(drive, {}, {}), 0U);
}

TEST(FaceMerging, Merge_MappedTwice6cmApart_IsOneByItsRays) {
  // The same wall, seen by half of the turns 6 cm farther off: the poses were wrong by that.
  MappedDrive drive = with_walls({{{3, 2}, {-1, 2}}});
  drive.faces.push_back(face_between({2.5, 2.06}, {-0.5, 2.06}));
  for (std::size_t scan = 5; scan < 10; ++scan) {
    for (std::size_t i = drive.first_point[scan]; i < drive.first_point[scan + 1]; ++i) {
      StraightPoint& point = drive.points[i];
      point.range_m *= 2.06F / 2.0F;
    }
  }
  EXPECT_EQ(merge_faces(drive, {}, {}), 0U) << "without the rays it might be a step";
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 1U);
}

TEST(FaceMerging, Merge_BoxBeforeAWall_StaysTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {-1, 2}}, {{1.3, 1.94}, {0.7, 1.94}}});
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 0U) << "the box hides the wall behind it";
}

TEST(FaceMerging, Merge_AcrossAnOpenGap_StaysTwo) {
  MappedDrive drive = with_walls({{{3, 2}, {1.2, 2}}, {{1, 2}, {-1, 2}}, {{6, 4}, {-4, 4}}});
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 0U) << "rays went through, 20 cm wide";
}

TEST(FaceMerging, Merge_AcrossAGapThatNothingWentThrough_IsOne) {
  MappedDrive drive = with_walls({{{3, 2}, {1.2, 2}}, {{1, 2}, {-1, 2}}, {{1.3, 1.8}, {0.9, 1.8}}});
  const auto evidence = gather_evidence(drive, {}, {});
  EXPECT_EQ(merge_faces(drive, evidence, {}), 1U);
}

}  // namespace
}  // namespace cornerd::survey
