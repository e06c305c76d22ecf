// SPDX-License-Identifier: MIT
#include "survey/right_angles.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

MappedDrive two_walls(double askew_rad) {
  MappedDrive drive;
  drive.faces.push_back(face_between({-3, -1}, {3, -1}));
  drive.faces.push_back(face_between({3, -1}, {3, 1}));
  drive.faces[1].set_line(drive.faces[1].normal_rad() + askew_rad, 0);
  for (MappedFace& face : drive.faces) {
    face.set_covariance(Eigen::Vector2d(1e-8, 1e-8).asDiagonal());
  }
  return drive;
}

TEST(RightAngles, NearlySquareWall_GetsABond) {
  const auto bonds = right_angles(two_walls(0.004));
  ASSERT_EQ(bonds.size(), 1U);
  EXPECT_EQ(bonds[0].one, 0U);
  EXPECT_NEAR(bonds[0].turn_rad, core::kPi / 2, 1e-12);
}

TEST(RightAngles, SlantedWall_IsLeftAlone) { EXPECT_TRUE(right_angles(two_walls(0.03)).empty()); }

TEST(RightAngles, UncertainWall_IsLeftAlone) {
  MappedDrive drive = two_walls(0);
  drive.faces[1].set_covariance(Eigen::Vector2d(1e-2, 1e-2).asDiagonal());
  EXPECT_TRUE(right_angles(drive).empty());
}

TEST(RightAngles, NoWalls_NoBonds) { EXPECT_TRUE(right_angles({}).empty()); }

}  // namespace
}  // namespace cornerd::survey
