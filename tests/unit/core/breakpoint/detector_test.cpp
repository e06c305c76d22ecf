// SPDX-License-Identifier: MIT
#include "core/breakpoint/detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <Eigen/LU>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

Detection detect(const Scan& scan) {
  Detector detector({}, {});
  Detection detection;
  detector.detect(testing::polar(scan), detection);
  return detection;
}

const Breakpoint* nearest(const Detection& detection, const Pose2& T_map_lidar, const Vec2& point) {
  const auto distance = [&](const Breakpoint& breakpoint) {
    return (T_map_lidar * breakpoint.position - point).norm();
  };
  const auto found = std::min_element(
      detection.breakpoints.begin(), detection.breakpoints.end(),
      [&](const Breakpoint& a, const Breakpoint& b) { return distance(a) < distance(b); });
  return found != detection.breakpoints.end() && distance(*found) < 0.03 ? &*found : nullptr;
}

TEST(Detector, LShapedRoom_FiveInnerCornersAndEdge) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(21);
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.5, 2.2, 0.4, 1.5);
    const Detection detection = detect(source.take(*map, T_map_lidar));
    for (const Vec2& corner : {Vec2(0, 0), Vec2(4, 0), Vec2(4, 1.8), Vec2(2.5, 3), Vec2(0, 3)}) {
      const Breakpoint* found = nearest(detection, T_map_lidar, corner);
      ASSERT_NE(found, nullptr) << corner.transpose();
      EXPECT_EQ(found->kind, BreakpointKind::kCorner);
      EXPECT_FALSE(found->convex);
      EXPECT_NEAR(found->opening_rad, kPi / 2, radians(6));
    }
    const Breakpoint* edge = nearest(detection, T_map_lidar, {2.5, 1.8});
    ASSERT_NE(edge, nullptr);
    EXPECT_TRUE(edge->convex);
  }
}

TEST(Detector, CornerWalls_DirectionsMatchMap) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(22);
  const Pose2 T_map_lidar{1.2, 0.9, 2.0};
  const Detection detection = detect(source.take(*map, T_map_lidar));
  ASSERT_EQ(detection.breakpoints.size(), 4U);
  for (const Corner& corner : map->corners()) {
    if (corner.is_convex()) continue;
    const Breakpoint* found = nearest(detection, T_map_lidar, corner.position);
    ASSERT_NE(found, nullptr);
    const double theta = T_map_lidar.theta_rad;
    EXPECT_NEAR(angle_between(found->left_wall_rad + theta, corner.left_face_rad), 0, 0.05);
    EXPECT_NEAR(angle_between(found->right_wall_rad + theta, corner.right_face_rad), 0, 0.05);
  }
}

TEST(Detector, WallInFrontOfAnother_EndsInTerminal) {
  FloorPlan plan = testing::rectangular_room(4, 3);
  plan.walls.push_back({{0, 1.5}, {1.2, 1.5}, 0.01});
  const WallMap map(plan);
  testing::ScanSource source(23);
  const Pose2 T_map_lidar{0.7, 0.6, 0};
  const Detection detection = detect(source.take(map, T_map_lidar));
  const Breakpoint* end = nearest(detection, T_map_lidar, {1.205, 1.495});
  ASSERT_NE(end, nullptr);
  EXPECT_EQ(end->kind, BreakpointKind::kTerminal);
  EXPECT_TRUE(end->wall_on_left);
  EXPECT_FALSE(end->wall_on_right);
  EXPECT_NEAR(std::abs(end->left_wall_rad), kPi, 0.05);
  // Where the wall behind leaves the shadow there is no breakpoint.
  const Vec2 shadow =
      T_map_lidar.translation() + (Vec2(1.205, 1.495) - T_map_lidar.translation()) * (2.4 / 0.895);
  EXPECT_EQ(nearest(detection, T_map_lidar, shadow), nullptr);
}

TEST(Detector, CornerCovariance_IsConsistent) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(24);
  double nees = 0;
  int count = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.5, 2.5, 0.5, 1.5);
    const Detection detection = detect(source.take(*map, T_map_lidar));
    for (const Corner& corner : map->corners()) {
      const Breakpoint* found = nearest(detection, T_map_lidar, corner.position);
      if (corner.is_convex() || found == nullptr) continue;
      const Vec2 error = found->position - T_map_lidar.inverse() * corner.position;
      nees += error.dot(found->covariance.inverse() * error);
      ++count;
    }
  }
  EXPECT_GT(count, 1100);
  EXPECT_GT(nees / count, 1.2);  // 2 where it is consistent
  EXPECT_LT(nees / count, 2.8);
}

TEST(Detector, ScanRotatedAcrossSeam_SameCorners) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  for (int k = 0; k < 36; ++k) {
    testing::ScanSource source(25);
    const Pose2 T_map_lidar{1.2, 0.9, radians(10 * k)};
    EXPECT_EQ(detect(source.take(*map, T_map_lidar)).breakpoints.size(), 4U) << k;
  }
}

}  // namespace
}  // namespace cornerd::core
