// SPDX-License-Identifier: MIT
#include "replay/simulator/corner_truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

using core::Pose2;
using core::Vec2;
using core::WallMap;

constexpr double kMaxRange_m = 12;

/// A scan of a perfect sensor: `count` rays from bearing -pi on.
core::PolarScan perfect_scan(const WallMap& map, const Pose2& pose, int count,
                             const std::function<double(double, double)>& change = {}) {
  core::Scan scan;
  for (int i = 0; i < count; ++i) {
    core::Sample sample;
    const double bearing_rad = -core::kPi + core::kTwoPi * (i + 0.5) / count;
    const double range_m =
        map.range_along(pose.translation(), pose.theta_rad + bearing_rad, kMaxRange_m);
    sample.bearing_rad = static_cast<float>(bearing_rad);
    sample.range_m = static_cast<float>(change ? change(bearing_rad, range_m) : range_m);
    scan.add(sample);
  }
  core::PolarScan points;
  points.assign(scan, 0.15, kMaxRange_m);
  return points;
}

std::size_t count(const CornerTruth& truth, CornerView view) {
  const auto corners = truth.corners();
  return static_cast<std::size_t>(
      std::count_if(corners.begin(), corners.end(),
                    [&](const CornerObservation& corner) { return corner.view == view; }));
}

/// The corner nearest to a point of the map.
const CornerObservation* corner_at(const CornerTruth& truth, const Pose2& pose, const Vec2& point) {
  for (const CornerObservation& corner : truth.corners()) {
    if ((pose * corner.position - point).norm() < 1e-6) return &corner;
  }
  return nullptr;
}

WallMap room_with(const std::vector<core::Wall>& walls) {
  core::FloorPlan plan = make_room()->plan();  // 2 by 3 m
  plan.walls.insert(plan.walls.end(), walls.begin(), walls.end());
  return WallMap(plan);
}

TEST(CornerTruth, RectangularRoom_HasFourSupportedCorners) {
  const auto map = make_room();
  const Pose2 pose{0.9, 1.2, 0.7};
  const auto scan = perfect_scan(*map, pose, 400);
  CornerTruth truth(*map, kMaxRange_m);
  truth.observe(pose, scan.points());

  ASSERT_EQ(truth.corners().size(), 4u);
  EXPECT_EQ(count(truth, CornerView::kSupported), 4u);
  std::uint32_t left = 0;
  for (const CornerObservation& corner : truth.corners()) {
    left += corner.left_returns;
    EXPECT_LT((pose * corner.position - map->corners()[corner.corner].position).norm(), 1e-9);
  }
  EXPECT_EQ(left, 400u);  // every return lies on the left wall of one corner
  EXPECT_TRUE(truth.occlusion_edges().empty());

  // The wall at the bottom spans atan(0.9 / 1.2) + atan(1.1 / 1.2) of the circle: 88.2 of 400 rays.
  const CornerObservation* origin = corner_at(truth, pose, {0, 0});
  ASSERT_NE(origin, nullptr);
  EXPECT_NEAR(origin->left_returns, 400 * (0.6435 + 0.7419) / core::kTwoPi, 1);
}

TEST(CornerTruth, FewReturns_DecideTheView) {
  const auto map = make_room();
  const Pose2 pose{1, 1.5, 0};
  const auto only = [&](int rays_below, int rays_above) {
    // Of 360 rays those nearest to the corner at (2, 3), at atan2(1.5, 1) = 56.3 degrees.
    return perfect_scan(*map, pose, 360, [=](double bearing_rad, double range_m) {
      const double from_corner = core::degrees(bearing_rad) - 56.31;
      return from_corner > -rays_below && from_corner < rays_above ? range_m : 0;
    });
  };
  CornerTruth truth(*map, kMaxRange_m);
  const auto observe = [&](int below, int above) {
    truth.observe(pose, only(below, above).points());
    return corner_at(truth, pose, {2, 3});
  };

  const CornerObservation* corner = observe(5, 5);
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->right_returns, 5u);
  EXPECT_EQ(corner->left_returns, 5u);
  EXPECT_EQ(corner->view, CornerView::kSupported);
  corner = observe(4, 9);
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->right_returns, 4u);
  EXPECT_EQ(corner->left_returns, 9u);
  EXPECT_EQ(corner->view, CornerView::kVisible);
  corner = observe(9, 0);
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->view, CornerView::kOneSided);
  EXPECT_EQ(observe(0, 0), nullptr);
}

TEST(CornerTruth, WrongRanges_CountForNoFace) {
  const auto map = make_room();
  const Pose2 pose{1, 1.5, 0};
  const auto scan = perfect_scan(*map, pose, 400, [](double bearing_rad, double range_m) {
    return bearing_rad > 0 ? range_m : range_m / 2;  // obstacles on the right side
  });
  CornerTruth truth(*map, kMaxRange_m);
  truth.observe(pose, scan.points());
  const CornerObservation* corner = corner_at(truth, pose, {0, 0});
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->left_returns, 0u);  // the wall at y = 0
  EXPECT_EQ(corner->view, CornerView::kOneSided);
  corner = corner_at(truth, pose, {2, 3});
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->view, CornerView::kSupported);
}

TEST(CornerTruth, FarCornerWithFewRays_IsNotSupported) {
  core::FloorPlan plan;  // a corridor, seen from one end
  plan.walls = {{{0, 0}, {8, 0}, 0}, {{8, 0}, {8, 1}, 0}, {{8, 1}, {0, 1}, 0}, {{0, 1}, {0, 0}, 0}};
  const WallMap map(plan);
  const Pose2 pose{0.5, 0.5, 0};
  CornerTruth truth(map, kMaxRange_m);
  truth.observe(pose, perfect_scan(map, pose, 400).points());  // its end: 7.6 degrees, 8.5 rays
  EXPECT_EQ(count(truth, CornerView::kSupported), 4u);
  truth.observe(pose, perfect_scan(map, pose, 100).points());
  EXPECT_EQ(count(truth, CornerView::kSupported), 2u);
  EXPECT_EQ(count(truth, CornerView::kVisible), 2u);
}

TEST(CornerTruth, WallBeyondMaxRange_GivesNothing) {
  const auto map = make_room();
  const Pose2 pose{0.5, 0.5, 0};
  CornerTruth truth(*map, 1.9);  // reaches the corner (2, 0), but not the one at (2, 3)
  truth.observe(pose, perfect_scan(*map, pose, 400).points());
  EXPECT_NE(corner_at(truth, pose, {2, 0}), nullptr);
  const CornerObservation* far_corner = corner_at(truth, pose, {2, 3});
  EXPECT_TRUE(far_corner == nullptr || far_corner->view != CornerView::kSupported);
}

TEST(CornerTruth, EndOfAThickWall_HasOneVisibleAndOneOneSidedCorner) {
  const WallMap map = room_with({{{1, 0}, {1, 0.991}, 0.018}});  // stands up to y = 1
  const Pose2 pose{0.4, 1.3, -2};
  CornerTruth truth(map, kMaxRange_m);
  truth.observe(pose, perfect_scan(map, pose, 1600).points());

  const CornerObservation* near_corner = corner_at(truth, pose, {0.991, 1});
  const CornerObservation* far_corner = corner_at(truth, pose, {1.009, 1});
  ASSERT_NE(near_corner, nullptr);
  ASSERT_NE(far_corner, nullptr);
  // The end of 18 mm, seen under 0.0075 rad at 0.66 m: one or two of 1,600 rays.
  EXPECT_GE(near_corner->left_returns, 1u);
  EXPECT_LE(near_corner->left_returns, 3u);
  EXPECT_EQ(near_corner->view, CornerView::kVisible);
  EXPECT_EQ(far_corner->view, CornerView::kOneSided);
}

TEST(CornerTruth, EndSeenHeadOn_HasOneSidedCorners) {
  const WallMap map = room_with({{{1, 0}, {1, 0.991}, 0.018}});
  const Pose2 pose{1, 1.3, 0};
  CornerTruth truth(map, kMaxRange_m);
  truth.observe(pose, perfect_scan(map, pose, 1600).points());
  for (const double x : {0.991, 1.009}) {
    const CornerObservation* corner = corner_at(truth, pose, {x, 1});
    ASSERT_NE(corner, nullptr);
    EXPECT_EQ(corner->view, CornerView::kOneSided);
  }
}

TEST(CornerTruth, CornerBehindAWall_IsHidden) {
  const WallMap map = room_with({{{1.6, 2.4}, {1.4, 2.6}, 0}});  // before the corner at (2, 3)
  const Pose2 pose{1, 2, 0};
  CornerTruth truth(map, kMaxRange_m);
  truth.observe(pose, perfect_scan(map, pose, 800).points());
  const CornerObservation* corner = corner_at(truth, pose, {2, 3});
  ASSERT_NE(corner, nullptr);
  EXPECT_GE(std::min(corner->left_returns, corner->right_returns), kSupportReturns);
  EXPECT_EQ(corner->view, CornerView::kHidden);
}

TEST(CornerTruth, RoomBehindAWall_IsNotObserved) {
  core::FloorPlan plan = make_room()->plan();
  plan.walls.push_back({{2, 3}, {5, 3}, 0});
  plan.walls.push_back({{5, 3}, {5, 0}, 0});
  const WallMap map(plan);
  const Pose2 pose{1, 1, 0};
  CornerTruth truth(map, kMaxRange_m);
  truth.observe(pose, perfect_scan(map, pose, 800).points());
  EXPECT_EQ(corner_at(truth, pose, {5, 3}), nullptr);
  EXPECT_EQ(truth.corners().size(), 4u);
}

TEST(CornerTruth, WallBeforeAnother_HasTwoOcclusionEdges) {
  const WallMap map = room_with({{{0.8, 2}, {1.2, 2}, 0}});
  const Pose2 pose{1, 1, 0.3};
  CornerTruth truth(map, kMaxRange_m);
  truth.observe(pose, perfect_scan(map, pose, 3600).points());
  // Seen from (1, 1) the piece at y = 2 hides x = 0.6 to 1.4 of the wall at y = 3.
  ASSERT_EQ(truth.occlusion_edges().size(), 2u);
  std::vector<double> ends;
  for (const Vec2& end : truth.occlusion_edges()) {
    EXPECT_NEAR((pose * end).y(), 3, 1e-6);
    ends.push_back((pose * end).x());
  }
  std::sort(ends.begin(), ends.end());
  EXPECT_NEAR(ends[0], 0.6, 0.01);
  EXPECT_NEAR(ends[1], 1.4, 0.01);
  EXPECT_EQ(count(truth, CornerView::kSupported), 4u);
  EXPECT_EQ(count(truth, CornerView::kOneSided), 2u);  // the ends of the piece
}

TEST(CornerTruth, WallMeetingMiddleOfAnother_SplitsItsReturns) {
  const WallMap map = room_with({{{1, 3}, {1, 2}, 0}});
  const Pose2 pose{0.5, 2.5, 0};
  CornerTruth truth(map, kMaxRange_m);
  truth.observe(pose, perfect_scan(map, pose, 720).points());
  const CornerObservation* corner = corner_at(truth, pose, {1, 3});
  ASSERT_NE(corner, nullptr);
  EXPECT_EQ(corner->view, CornerView::kSupported);
  // Of the wall at y = 3 only the half on this side: 90 degrees of the circle.
  EXPECT_NEAR(corner->left_returns, 180, 1);
}

TEST(CornerTruth, EmptyScan_ShowsNothing) {
  const auto map = make_room();
  CornerTruth truth(*map, kMaxRange_m);
  truth.observe({1, 1, 0}, {});
  EXPECT_TRUE(truth.corners().empty());
  EXPECT_TRUE(truth.occlusion_edges().empty());
}

}  // namespace
}  // namespace cornerd::replay
