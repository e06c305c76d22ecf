// SPDX-License-Identifier: MIT
#include "survey/face_evidence.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// A wall with a doorway at x from 1 to 2, and another wall 2 m behind it.
MappedDrive doorway() {
  const std::vector<std::pair<Vec2, Vec2>> walls = {
      {{3, 2}, {2, 2}}, {{1, 2}, {-1, 2}}, {{5, 4}, {-3, 4}}};
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i < 10; ++i) trajectory.push_back({0.5 + 0.2 * i, 0, 0});
  MappedDrive drive = mapped_drive(walls, trajectory);
  add_returns(drive);
  return drive;
}

TEST(Evidence, Gather_WallWithDoorway_HasHitsAndPasses) {
  const MappedDrive drive = doorway();
  const auto evidence = gather_evidence(drive, {}, {});
  const FaceEvidence& wall = evidence[0];
  for (std::size_t cell = 0; cell < wall.size(); ++cell) {
    const double along_m = wall.along_of(cell) + FaceEvidence::kCell_m / 2;
    if (std::abs(along_m) < 0.45) {
      EXPECT_TRUE(wall.is_wall(cell)) << along_m;
    } else if (along_m > 0.55) {
      EXPECT_TRUE(wall.is_open(cell)) << "the doorway, " << along_m;
    }
  }
}

TEST(Evidence, OpenBetween_AcrossDoorway_IsItsWidth) {
  const MappedDrive drive = doorway();
  const auto evidence = gather_evidence(drive, {}, {});
  const LineLandmark& wall = drive.faces[0];
  EXPECT_NEAR(evidence[0].open_between(wall.end_m(), wall.end_m() + 0.3), 0.3, 0.045);
  EXPECT_EQ(evidence[0].open_between(wall.begin_m() + 0.1, wall.end_m() - 0.1), 0);
}

TEST(Evidence, Gather_TwoFacesOnOneLine_CountEachReturnOnce) {
  MappedDrive drive = doorway();
  LineLandmark ghost = drive.faces[0];
  ghost.observations = 3;
  ghost.set_line(ghost.normal_rad() + 0.01, 0.002);
  drive.faces.push_back(ghost);
  const auto evidence = gather_evidence(drive, {}, {});
  std::size_t hits = 0;
  for (std::size_t cell = 0; cell < evidence[3].size(); ++cell) hits += evidence[3].hits(cell);
  EXPECT_EQ(hits, 0U);
}

TEST(Evidence, Gather_FromBehindFace_CountsNothing) {
  const std::vector<std::pair<Vec2, Vec2>> walls = {{{-1, 2}, {1, 2}}};  // faces away
  MappedDrive drive = mapped_drive(walls, std::vector<core::Pose2>(5));
  add_returns(drive);
  const auto evidence = gather_evidence(drive, {}, {});
  for (std::size_t cell = 0; cell < evidence[0].size(); ++cell) {
    EXPECT_EQ(evidence[0].hits(cell) + evidence[0].passes(cell), 0U);
  }
}

}  // namespace
}  // namespace cornerd::survey
