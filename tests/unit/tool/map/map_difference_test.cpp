// SPDX-License-Identifier: MIT
#include "tool/map/map_difference.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace cornerd::tool {
namespace {

core::FloorPlan plan_of_a_room() {
  core::FloorPlan plan;
  plan.walls = {
      {{0, 0}, {4, 0}, 0.1}, {{4, 0}, {4, 3}, 0.1}, {{4, 3}, {0, 3}, 0.1}, {{0, 3}, {0, 0}, 0.1}};
  return plan;
}

TEST(MapDifference, SameMap_NoneAlsoWhereWallsAreTurnedOrInPieces) {
  core::FloorPlan b = plan_of_a_room();
  std::swap(b.walls[1].from, b.walls[1].to);
  b.walls[0].to = {1.5, 0};
  b.walls.push_back({{1.4, 0}, {4, 0}, 0.1});
  for (const auto& [one, other] :
       {std::pair(plan_of_a_room(), plan_of_a_room()), std::pair(plan_of_a_room(), b),
        std::pair(b, plan_of_a_room())}) {
    const MapDifference difference = compare_maps(one, other, {});
    EXPECT_TRUE(difference.moved.empty());
    EXPECT_TRUE(difference.gone.empty());
    EXPECT_TRUE(difference.added.empty());
  }
}

TEST(MapDifference, WallThatAnotherContinues_IsTheSame) {
  core::FloorPlan plan = plan_of_a_room();
  plan.walls.push_back({{3.9, 0}, {4.15, 0}, 0.1});
  EXPECT_TRUE(compare_maps(plan, plan, {}).moved.empty());
}

TEST(MapDifference, MovedGoneAndNewWalls_AreNamed) {
  core::FloorPlan b = plan_of_a_room();
  b.walls[0].from.y() = b.walls[0].to.y() = 0.03;  // to its left
  b.walls[2] = {{4, 3}, {0.2, 3}, 0.14};           // shorter, thicker
  b.walls[1] = {{1, 1}, {2, 2}, 0.1};              // gone; another one is new
  const MapDifference difference = compare_maps(plan_of_a_room(), b, {});
  ASSERT_EQ(difference.moved.size(), 2U);
  EXPECT_EQ(difference.moved[0].wall, 0U);
  EXPECT_NEAR(difference.moved[0].across_m, 0.03, 1e-12);
  EXPECT_NEAR(difference.moved[0].from_along_m, 0, 1e-12);
  EXPECT_EQ(difference.moved[1].wall, 2U);
  EXPECT_NEAR(difference.moved[1].across_m, 0, 1e-12);
  EXPECT_NEAR(difference.moved[1].from_along_m, 0, 1e-12);
  EXPECT_NEAR(difference.moved[1].to_along_m, -0.2, 1e-12);
  EXPECT_NEAR(difference.moved[1].thicker_m, 0.04, 1e-12);
  EXPECT_EQ(difference.gone, std::vector<std::size_t>{1});
  EXPECT_EQ(difference.added, std::vector<std::size_t>{1});
}

TEST(MapDifference, ReachAndTolerance_Decide) {
  core::FloorPlan b = plan_of_a_room();
  for (core::Wall& wall : b.walls) {
    wall.from.x() += 0.1;
    wall.to.x() += 0.1;
  }
  EXPECT_EQ(compare_maps(plan_of_a_room(), b, {}).moved.size(), 4U);
  EXPECT_TRUE(compare_maps(plan_of_a_room(), b, {.tolerance_m = 0.11}).moved.empty());
  EXPECT_EQ(compare_maps(plan_of_a_room(), b, {.reach_m = 0.05}).gone.size(), 2U);
}

TEST(MapDifference, TextAndJson_SayTheSame) {
  core::FloorPlan b = plan_of_a_room();
  b.walls[0].from.y() = b.walls[0].to.y() = 0.03;
  b.walls.pop_back();
  const core::FloorPlan a = plan_of_a_room();
  const MapDifference difference = compare_maps(a, b, {});
  EXPECT_EQ(
      difference_text(a, b, difference),
      "1 moved, 1 gone, 0 new\n"
      "moved    wall 0 from (0.000, 0.000) to (4.000, 0.000): across +0.030 m, ends +0.000 and "
      "+0.000 m, thickness +0.000 m\n"
      "gone     wall 3 from (0.000, 3.000) to (0.000, 0.000)\n");
  const auto json = nlohmann::json::parse(difference_json(a, b, difference));
  EXPECT_EQ(json.at("moved").at(0).at("wall"), 0);
  EXPECT_NEAR(json["moved"][0].at("across").get<double>(), 0.03, 1e-12);
  EXPECT_EQ(json.at("gone").at(0).at("from"), nlohmann::json({0.0, 3.0}));
  EXPECT_TRUE(json.at("new").empty());
}

}  // namespace
}  // namespace cornerd::tool
