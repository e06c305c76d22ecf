// SPDX-License-Identifier: MIT
#include "plan/wall_pairing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cornerd::plan {
namespace {

using core::Vec2;

std::vector<DrawnLine> outline(const std::vector<Vec2>& points) {
  std::vector<DrawnLine> lines;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lines.push_back({points[i], points[(i + 1) % points.size()]});
  }
  return lines;
}

core::WallMap map_of(const PairedWalls& paired) {
  core::FloorPlan plan;
  plan.walls = paired.walls;
  return core::WallMap(std::move(plan));
}

TEST(WallPairing, Rectangle_OneWallOfItsThickness) {
  const auto paired = pair_walls(outline({{1, 1}, {5, 1}, {5, 1.2}, {1, 1.2}}), {});
  ASSERT_EQ(paired.walls.size(), 1U);
  EXPECT_EQ(paired.two_sided, 1U);
  EXPECT_NEAR(paired.walls[0].thickness_m, 0.2, 1e-9);
  const core::WallMap map = map_of(paired);
  EXPECT_NEAR((map.lower_left() - Vec2(1, 1)).norm(), 0, 1e-9);
  EXPECT_NEAR((map.upper_right() - Vec2(5, 1.2)).norm(), 0, 1e-9);
}

/// Two outlines, one within the other: corners are solid.
TEST(WallPairing, RoomOfTwoOutlines_IsSolidAroundAndFreeInside) {
  for (const double yaw_rad : {0.0, 0.4}) {
    const core::Pose2 placed{3, -2, yaw_rad};
    std::vector<DrawnLine> lines = outline({{0, 0}, {6, 0}, {6, 4}, {0, 4}});
    for (const DrawnLine& line : outline({{0.3, 0.3}, {5.7, 0.3}, {5.7, 3.7}, {0.3, 3.7}})) {
      lines.push_back(line);
    }
    for (DrawnLine& line : lines) line = {placed * line.from, placed * line.to};
    const auto paired = pair_walls(lines, {});
    EXPECT_EQ(paired.walls.size(), paired.two_sided);
    const core::WallMap map = map_of(paired);
    EXPECT_EQ(map.corners().size(), 8U);
    for (double x = 0.05; x < 6; x += 0.1) {
      for (double y = 0.05; y < 4; y += 0.1) {
        const bool is_inside = x > 0.3 && x < 5.7 && y > 0.3 && y < 3.7;
        EXPECT_EQ(map.is_solid(placed * Vec2(x, y)), !is_inside) << x << "," << y;
      }
    }
  }
}

/// A wall of 12 cm that joins one of 30 cm, drawn as one outline.
TEST(WallPairing, WallsThatMeet_JointIsSolid) {
  const auto paired = pair_walls(
      outline({{0, 0}, {8, 0}, {8, 0.3}, {4.12, 0.3}, {4.12, 3}, {4, 3}, {4, 0.3}, {0, 0.3}}), {});
  const core::WallMap map = map_of(paired);
  EXPECT_EQ(paired.walls.size(), paired.two_sided);
  EXPECT_TRUE(map.is_solid({4.06, 0.2}));
  EXPECT_TRUE(map.is_solid({4.06, 0.31}));
  EXPECT_EQ(map.corners().size(), 8U);
}

TEST(WallPairing, Corridor_IsNotFilled) {
  std::vector<DrawnLine> lines = outline({{0, 0}, {9, 0}, {9, 0.1}, {0, 0.1}});
  for (const DrawnLine& line : outline({{0, 0.6}, {9, 0.6}, {9, 0.7}, {0, 0.7}})) {
    lines.push_back(line);
  }
  const auto paired = pair_walls(lines, {});
  ASSERT_EQ(paired.walls.size(), 2U);
  EXPECT_FALSE(map_of(paired).is_solid({4, 0.35}));
}

TEST(WallPairing, SingleLines_AreThinWallsOnce) {
  const std::vector<DrawnLine> lines = {
      {{0, 0}, {2, 0}}, {{3, 0}, {1, 0}}, {{0, 0}, {0, 2}}, {{0, 0}, {0, 2}}};
  const auto paired = pair_walls(lines, {.thickest_m = 0.6, .thin_m = 0.05});
  ASSERT_EQ(paired.walls.size(), 2U);
  EXPECT_EQ(paired.two_sided, 0U);
  for (const core::Wall& wall : paired.walls) EXPECT_EQ(wall.thickness_m, 0.05);
}

TEST(WallPairing, Hatching_IsRefusedAtOnce) {
  std::vector<DrawnLine> crossing;
  for (int i = 0; i < 14'000; ++i) {
    crossing.push_back({{30.0 * (i % 5'021) / 5'021, 0}, {30.0 * (i % 4'999) / 4'999, 30}});
  }
  EXPECT_THROW(pair_walls(crossing, {}), PlanError);
}

}  // namespace
}  // namespace cornerd::plan
