// SPDX-License-Identifier: MIT
#include "survey/face_splitting.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

/// Along a wall of 12 m; another one is in sight from both ends of the way alone.
MappedDrive drive_along_a_wall() {
  const std::vector<std::pair<core::Vec2, core::Vec2>> walls = {{{-1, -1}, {11, -1}},
                                                                {{2, 3}, {-1, 3}}};
  std::vector<core::Pose2> way;
  for (int i = 0; i <= 10; ++i) way.push_back({1.0 * i, 0, 0});
  MappedDrive drive = mapped_drive(walls, way);
  std::erase_if(drive.observations, [](const Observation& observation) {
    return observation.face == 1 && observation.scan > 1 && observation.scan < 9;
  });
  return drive;
}

TEST(SplitRevisited, WallThatWasOutOfSight_IsTwo) {
  MappedDrive drive = drive_along_a_wall();
  EXPECT_EQ(split_revisited(drive, 8, 5), 1U);
  ASSERT_EQ(drive.faces.size(), 3U);
  EXPECT_EQ(drive.faces[0].sightings, 11U);
  EXPECT_EQ(drive.faces[1].sightings, 2U);
  EXPECT_EQ(drive.faces[1].last_scan, 1U);
  EXPECT_EQ(drive.faces[2].sightings, 2U);
  EXPECT_EQ(drive.faces[2].first_scan, 9U);
  for (const Observation& observation : drive.observations) {
    EXPECT_EQ(observation.face == 2, observation.scan >= 9 && observation.face != 0);
  }
}

TEST(SplitRevisited, InSightAgainBeforeTheTurn_StaysOne) {
  MappedDrive drive = drive_along_a_wall();
  EXPECT_EQ(split_revisited(drive, 10, 5), 0U);
}

TEST(SplitRevisited, OutOfSightForAShorterWay_StaysOne) {
  MappedDrive drive = drive_along_a_wall();
  EXPECT_EQ(split_revisited(drive, 8, 9), 0U);
}

}  // namespace
}  // namespace cornerd::survey
