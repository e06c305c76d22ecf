// SPDX-License-Identifier: MIT
#include "core/map/wall_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

FloorPlan plan_of(std::vector<Wall> walls) {
  FloorPlan plan;
  plan.walls = std::move(walls);
  return plan;
}

const Corner* corner_at(const WallMap& map, const Vec2& point) {
  const auto corners = map.corners();
  const auto found = std::find_if(corners.begin(), corners.end(), [&](const Corner& corner) {
    return (corner.position - point).norm() < 1e-4;
  });
  return found == corners.end() ? nullptr : &*found;
}

TEST(WallMap, SingleWall_FourFacesWithSquareEnds) {
  const WallMap map(plan_of({{{0, 0}, {2, 0}, 0.2}}));
  EXPECT_EQ(map.faces().size(), 4U);
  ASSERT_EQ(map.corners().size(), 4U);
  for (const Corner& corner : map.corners()) {
    EXPECT_TRUE(corner.is_convex());
    EXPECT_NEAR(corner.opening_rad, 1.5 * kPi, 1e-9);
  }
  EXPECT_NE(corner_at(map, {-0.1, -0.1}), nullptr);
  EXPECT_NE(corner_at(map, {2.1, 0.1}), nullptr);
}

TEST(WallMap, OpenEnd_HasNoCorners) {
  Wall thick{{0, 0}, {2, 0}, 0.2};
  thick.is_open = {false, true};
  Wall line{{0, 3}, {2, 3}, 0};
  line.is_open = {true, false};
  const WallMap map(plan_of({thick, line}));
  EXPECT_NE(corner_at(map, {-0.1, -0.1}), nullptr);
  EXPECT_NE(corner_at(map, {-0.1, 0.1}), nullptr);
  EXPECT_NE(corner_at(map, {2, 3}), nullptr);
  EXPECT_EQ(map.corners().size(), 3U);
  EXPECT_EQ(map.faces().size(), 6U);
}

TEST(WallMap, Faces_FreeSpaceIsOnLeft) {
  const WallMap map(testing::l_shaped_room());
  for (const Face& face : map.faces()) {
    const Vec2 middle = (face.from + face.to) / 2;
    EXPECT_FALSE(map.is_solid(middle + 1e-3 * face.normal));
    EXPECT_TRUE(map.is_solid(middle - 1e-3 * face.normal));
    EXPECT_NEAR(face.normal.dot(middle), face.offset_m, 1e-12);
  }
}

TEST(WallMap, ClosedRoom_InnerAndOuterOutline) {
  const WallMap map(testing::rectangular_room(3, 2));
  EXPECT_EQ(map.faces().size(), 8U);
  ASSERT_EQ(map.corners().size(), 8U);
  const Corner* inner = corner_at(map, {0, 0});
  ASSERT_NE(inner, nullptr);
  EXPECT_FALSE(inner->is_convex());
  EXPECT_NEAR(inner->opening_rad, kPi / 2, 1e-9);
  EXPECT_NEAR(inner->bisector_rad(), kPi / 4, 1e-9);
  // From inside, facing the corner, the wall along x is on the left.
  EXPECT_NEAR(inner->left_face_rad, 0, 1e-9);
  EXPECT_NEAR(inner->right_face_rad, kPi / 2, 1e-9);
}

TEST(WallMap, TouchingWalls_NoSurfaceBetween) {
  const WallMap map(plan_of({{{0, 0}, {4, 0}, 0.2}, {{2, 0}, {2, 1}, 0.2}}));
  // The long wall's upper side is cut in two and its other three sides are whole; the short wall
  // shows two sides and its end.
  EXPECT_EQ(map.faces().size(), 8U);
  const Corner* inner = corner_at(map, {1.9, 0.1});
  ASSERT_NE(inner, nullptr);
  EXPECT_FALSE(inner->is_convex());
}

TEST(WallMap, WallDrawnInPieces_IsOneWall) {
  const WallMap map(plan_of({{{0, 0}, {1, 0}, 0.1}, {{1, 0}, {2, 0}, 0.1}, {{2, 0}, {3, 0}, 0.1}}));
  EXPECT_EQ(map.faces().size(), 4U);
  EXPECT_EQ(map.corners().size(), 4U);
}

TEST(WallMap, SameWallTwice_IsOneWall) {
  const Wall wall{{0, 0}, {1, 1}, 0.05};
  EXPECT_EQ(WallMap(plan_of({wall, wall})).faces().size(), 4U);
  const Wall line{{0, 0}, {1, 1}, 0};
  EXPECT_EQ(WallMap(plan_of({line, line})).faces().size(), 2U);
}

TEST(WallMap, LineWall_VisibleFromBothSidesWithCornersAtEnds) {
  const WallMap map(plan_of({{{0, 0}, {2, 0}, 0}}));
  EXPECT_EQ(map.faces().size(), 2U);
  EXPECT_NEAR(map.range_along({1, 1}, -kPi / 2, 12), 1, 1e-12);
  EXPECT_NEAR(map.range_along({1, -1}, kPi / 2, 12), 1, 1e-12);
  ASSERT_EQ(map.corners().size(), 2U);
  EXPECT_NEAR(map.corners()[0].opening_rad, kTwoPi, 1e-9);
}

TEST(WallMap, CrossingLineWalls_FourCornersAtCrossing) {
  const WallMap map(plan_of({{{-1, 0}, {1, 0}, 0}, {{0, -1}, {0, 1}, 0}}));
  int at_crossing = 0;
  for (const Corner& corner : map.corners()) {
    if (corner.position.norm() > 1e-6) continue;
    ++at_crossing;
    EXPECT_NEAR(corner.opening_rad, kPi / 2, 1e-9);
  }
  EXPECT_EQ(at_crossing, 4);
}

TEST(WallMap, Ray_HitsNearestFaceOrNone) {
  const WallMap map(testing::rectangular_room(3, 2));
  EXPECT_NEAR(map.range_along({1, 1}, 0, 12), 2, 1e-12);
  EXPECT_NEAR(map.range_along({1, 1}, kPi, 12), 1, 1e-12);
  EXPECT_NEAR(map.range_along({1, 1}, kPi / 4, 12), std::sqrt(2), 1e-12);
  EXPECT_EQ(map.range_along({1, 1}, 0, 1.5), 0);
  EXPECT_EQ(map.range_along({10, 10}, 0, 12), 0);
}

TEST(WallMap, OverlappingRooms_FirstContainingPoint) {
  const WallMap map(testing::l_shaped_room());
  ASSERT_TRUE(map.room_at({1, 2.5}));
  EXPECT_EQ(map.plan().rooms[*map.room_at({1, 2.5})].name, "nook");
  EXPECT_EQ(map.plan().rooms[*map.room_at({1, 1})].name, "hall");
  EXPECT_FALSE(map.room_at({9, 9}));
}

TEST(WallMap, WallWithoutExtent_ThrowsWithIndex) {
  try {
    const WallMap map(plan_of({{{0, 0}, {1, 0}, 0.1}, {{2, 2}, {2, 2}, 0}}));
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("wall 1"), std::string::npos) << error.what();
  }
}

TEST(WallMap, NonFiniteNumbers_Throw) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WallMap(plan_of({{{0, nan}, {1, 0}, 0.1}})), std::invalid_argument);
  EXPECT_THROW(WallMap(plan_of({{{0, 0}, {1, 0}, -0.1}})), std::invalid_argument);
  EXPECT_THROW(WallMap(plan_of({})), std::invalid_argument);
}

TEST(WallMap, Post_IsSquareOfItsThickness) {
  const WallMap map(plan_of({{{1, 1}, {1, 1}, 0.3}}));
  EXPECT_EQ(map.faces().size(), 4U);
  EXPECT_TRUE(map.is_solid({1.1, 1.1}));
  EXPECT_FALSE(map.is_solid({1.2, 1}));
}

// Quadratic in the walls, this test takes hours.
TEST(WallMap, HundredThousandWallsInOnePlace_OneSolid) {
  FloorPlan plan;
  for (int i = 0; i < 100'000; ++i) {
    const Vec2 one(0, 0);
    const Vec2 other(4, 0);
    plan.walls.push_back(i % 2 == 0 ? Wall{one, other, 0.1} : Wall{other, one, 0.1});
  }
  const WallMap map(std::move(plan));
  EXPECT_EQ(map.faces().size(), 4U);
  EXPECT_EQ(map.corners().size(), 4U);
}

TEST(WallMap, LineWallsThroughOnePoint_OneCornerForEachSector) {
  constexpr int kWalls = 100;
  FloorPlan plan;
  for (int i = 0; i < kWalls; ++i) {
    const Vec2 end = 3 * unit_vector(kPi * i / kWalls);
    plan.walls.push_back({-end, end, 0});
  }
  const WallMap map(std::move(plan));
  const auto is_in_the_middle = [](const Corner& corner) { return corner.position.norm() < 1e-4; };
  EXPECT_EQ(std::count_if(map.corners().begin(), map.corners().end(), is_in_the_middle),
            2 * kWalls);
  EXPECT_EQ(map.corners().size(), 4U * kWalls);
}

TEST(WallMap, WallWithSigma_ItsFacesHaveIt) {
  FloorPlan plan;
  plan.walls = {{{0, 0}, {4, 0}, 0.1}, {{0, 2}, {4, 2}, 0.1, 0.03}};
  const WallMap map(std::move(plan));
  ASSERT_EQ(map.faces().size(), 8U);
  for (const Face& face : map.faces()) {
    EXPECT_EQ(face.sigma_m, face.from.y() > 1 ? 0.03 : 0);
  }
}

}  // namespace
}  // namespace cornerd::core
