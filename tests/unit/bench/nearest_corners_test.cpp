// SPDX-License-Identifier: MIT
#include "bench/nearest_corners.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

using core::Breakpoint;
using core::Pose2;
using core::Vec2;

const Pose2 kTrueRoomPlace{0.5, 0.7, 2.5};

/// A corner of the room of 2 by 3 m, detected `error` off its true position.
Breakpoint seen(const Vec2& corner, const Vec2& error = Vec2::Zero()) {
  Breakpoint breakpoint;
  breakpoint.position = kTrueRoomPlace.inverse() * (corner + error);
  return breakpoint;
}

TEST(NearestCorners, ExactCorners_ExactPose) {
  const std::vector breakpoints = {seen({2, 3}), seen({0, 0}), seen({2, 0})};
  const auto place = pose_from_nearest_corners(breakpoints, *replay::make_room(), kTrueRoomPlace);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x_m, 0.5, 1e-12);
  EXPECT_NEAR(place->y_m, 0.7, 1e-12);
  EXPECT_NEAR(place->theta_rad, 2.5, 1e-12);
}

TEST(NearestCorners, ThreeCorners_FarthestIsIgnored) {
  const std::vector breakpoints = {seen({2, 3}, {0.04, 0.03}), seen({0, 0}), seen({2, 0})};
  const auto place = pose_from_nearest_corners(breakpoints, *replay::make_room(), kTrueRoomPlace);
  ASSERT_TRUE(place);
  EXPECT_NEAR((place->translation() - kTrueRoomPlace.translation()).norm(), 0, 1e-12);
}

TEST(NearestCorners, DistanceError_IsSharedByBothCorners) {
  const std::vector breakpoints = {seen({0, 0}), seen({2, 0}, {0.02, 0})};
  const auto place = pose_from_nearest_corners(breakpoints, *replay::make_room(), kTrueRoomPlace);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x_m, 0.5 - 0.01, 1e-12);
  EXPECT_NEAR(place->y_m, 0.7, 1e-12);
}

TEST(NearestCorners, DetectionWithoutMapCorner_IsIgnored) {
  Breakpoint terminal = seen({0, 0}, {0.01, 0.05});
  terminal.kind = core::BreakpointKind::kTerminal;
  const std::vector breakpoints = {seen({0.5, 0.5}), terminal, seen({0, 0}), seen({2, 0}),
                                   seen({0.02, 0.02})};
  const auto place = pose_from_nearest_corners(breakpoints, *replay::make_room(), kTrueRoomPlace);
  ASSERT_TRUE(place);
  EXPECT_LT((place->translation() - kTrueRoomPlace.translation()).norm(), 0.03);
}

TEST(NearestCorners, OneCornerDetectedTwice_NoPose) {
  const auto map = replay::make_room();
  EXPECT_FALSE(pose_from_nearest_corners({}, *map, kTrueRoomPlace));
  const std::vector breakpoints = {seen({0, 0}), seen({0, 0}, {0.01, 0})};
  EXPECT_FALSE(pose_from_nearest_corners(breakpoints, *map, kTrueRoomPlace));
}

}  // namespace
}  // namespace cornerd::bench
