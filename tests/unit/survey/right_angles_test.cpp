// SPDX-License-Identifier: MIT
#include "survey/right_angles.hpp"

#include <gtest/gtest.h>

#include <array>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

constexpr std::array<std::uint32_t, 2> kBoth = {0, 1};

/// Observed in 20 scans: the angle between them is known to a hundredth of a degree.
MappedDrive two_walls(double askew_rad) {
  const core::Vec2 corner(3, -1);
  const std::vector<std::pair<core::Vec2, core::Vec2>> walls = {
      {{-3, -1}, corner}, {corner, corner + 2 * core::unit_vector(core::kPi / 2 + askew_rad)}};
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i < 20; ++i) trajectory.push_back({0.05 * i, 0, 0});
  return mapped_drive(walls, trajectory);
}

TEST(RightAngles, SquareWithinSigma_GetsConstraint) {
  const RightAngles found = right_angles(two_walls(core::radians(0.08)), kBoth);
  ASSERT_EQ(found.constraints.size(), 1U);
  EXPECT_EQ(found.constraints[0].one, 0U);
  EXPECT_NEAR(found.constraints[0].rotation_rad, core::kPi / 2, 1e-12);
  EXPECT_EQ(found.askew, 0U);
}

TEST(RightAngles, AskewBeyondSigmas_GetsNoConstraint) {
  const RightAngles found = right_angles(two_walls(core::radians(0.46)), kBoth);
  EXPECT_TRUE(found.constraints.empty());
  EXPECT_EQ(found.askew, 1U);
}

TEST(RightAngles, LargeSigma_GetsConstraintWithinHalfDegree) {
  for (const double askew_deg : {0.46, 0.6}) {
    MappedDrive drive = two_walls(core::radians(askew_deg));
    for (MatchedObservation& seen : drive.observations) {
      if (seen.face == 1) seen.seen.sigma_angle_rad = core::radians(3);
      if (seen.face == 1) seen.seen.sigma_offset_m = 0.1;
    }
    const RightAngles found = right_angles(drive, kBoth);
    EXPECT_EQ(found.constraints.size(), askew_deg < 0.5 ? 1U : 0U) << askew_deg;
  }
}

TEST(RightAngles, UnobservedFace_GetsNoConstraint) {
  MappedDrive drive = two_walls(0);
  std::erase_if(drive.observations, [](const MatchedObservation& seen) { return seen.face == 1; });
  EXPECT_TRUE(right_angles(drive, kBoth).constraints.empty());
}

TEST(RightAngles, FaceNotInList_GetsNoConstraint) {
  EXPECT_TRUE(right_angles(two_walls(0), std::span(kBoth).first(1)).constraints.empty());
}

TEST(RightAngles, NoFaces_GiveNoConstraints) {
  EXPECT_TRUE(right_angles({}, {}).constraints.empty());
}

}  // namespace
}  // namespace cornerd::survey
