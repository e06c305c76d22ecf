// SPDX-License-Identifier: MIT
#include "survey/plan_refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cornerd::survey {
namespace {

using core::Vec2;
using core::Wall;

/// A room of 5 x 4 m with a wall in it that ends 1.2 m before the other side.
core::FloorPlan true_plan() {
  core::FloorPlan plan;
  plan.name = "room";
  plan.walls = {{{0, 0}, {5, 0}, 0.1},
                {{5, 0}, {5, 4}, 0.1},
                {{5, 4}, {0, 4}, 0.1},
                {{0, 4}, {0, 0}, 0.1},
                {{2, 0}, {2, 2.8}, 0.1}};
  plan.rooms = {{"left", {{0, 0}, {2, 0}, {2, 4}, {0, 4}}}};
  return plan;
}

const std::vector<Vec2>& places() {
  static const std::vector<Vec2> all{{1, 1}, {1, 2}, {1, 3}, {2, 3.4}, {3, 3},  {4, 2},
                                     {4, 1}, {3, 1}, {3, 2}, {1.5, 3}, {1, 3.5}};
  return all;
}

/// The line that `wall` is on passes `point` at this distance.
double distance_m(const Wall& wall, const Vec2& point) {
  return std::abs(core::cross((wall.to - wall.from).normalized(), point - wall.from));
}

RefinedPlan refine(const core::FloorPlan& drawn) {
  return refine_plan(drawn, core::WallMap(true_plan()), places(), {});
}

TEST(PlanRefinement, WallDrawnOff_IsMovedAndMeetsItsNeighbours) {
  core::FloorPlan drawn = true_plan();
  drawn.walls[4].from = {2.06, -0.08};
  drawn.walls[4].to = {2.04, 2.72};
  drawn.walls[1].from.x() = drawn.walls[1].to.x() = 4.93;
  const RefinedPlan refined = refine(drawn);
  ASSERT_EQ(refined.plan.walls.size(), 5u);
  EXPECT_TRUE(refined.added.empty());
  EXPECT_TRUE(refined.contradicted.empty());
  EXPECT_TRUE(refined.unseen.empty());
  EXPECT_EQ(refined.moved_m.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const Wall truth = true_plan().walls[i];
    EXPECT_LT((refined.plan.walls[i].from - truth.from).norm(), 0.003) << i;
    EXPECT_LT((refined.plan.walls[i].to - truth.to).norm(), 0.003) << i;
    EXPECT_NEAR(refined.plan.walls[i].thickness_m, truth.thickness_m, 0.002) << i;
  }
  EXPECT_EQ(refined.plan.name, "room");
  EXPECT_EQ(refined.plan.rooms.size(), 1u);
}

TEST(PlanRefinement, MissingWall_IsAddedUpToItsNeighbour) {
  core::FloorPlan drawn = true_plan();
  drawn.walls.pop_back();
  const RefinedPlan refined = refine(drawn);
  ASSERT_EQ(refined.added.size(), 1u);
  EXPECT_LT(distance_m(refined.added[0], {2, 1}), 0.001);
  EXPECT_NEAR((refined.added[0].to - refined.added[0].from).norm(), 2.8, 0.1);
  EXPECT_EQ(refined.plan.walls.size(), 5u);
}

TEST(PlanRefinement, WallThatRaysWentThrough_IsLeftOut) {
  core::FloorPlan drawn = true_plan();
  drawn.walls.push_back({{3.2, 1.6}, {4.4, 1.6}, 0.1});
  const RefinedPlan refined = refine(drawn);
  ASSERT_FALSE(refined.contradicted.empty());
  EXPECT_EQ(refined.contradicted[0].wall, 5u);
  EXPECT_EQ(refined.plan.walls.size(), 5u);
}

TEST(PlanRefinement, ReturnsNearAWall_KeepIt) {
  core::FloorPlan drawn = true_plan();
  drawn.walls.push_back({{3.2, 1.6}, {4.4, 1.6}, 0.1});
  std::vector<Vec2> returns;
  for (double x_m = 3.2; x_m < 4.4; x_m += 0.02) returns.push_back({x_m, 1.63});
  const RefinedPlan refined = refine_plan(drawn, core::WallMap(true_plan()), places(), returns);
  EXPECT_TRUE(refined.contradicted.empty());
  ASSERT_EQ(refined.unseen.size(), 1u);
  EXPECT_EQ(refined.unseen[0].wall, 5u);
}

TEST(PlanRefinement, WallOutOfSight_StaysAsDrawnWithThePlansSigma) {
  core::FloorPlan drawn = true_plan();
  drawn.sigma_m = 0.04;
  drawn.walls.push_back({{8, 0}, {8, 4}, 0.1});
  const RefinedPlan refined = refine(drawn);
  ASSERT_EQ(refined.unseen.size(), 1u);
  const Wall& kept = refined.plan.walls.back();
  EXPECT_EQ(kept.from, drawn.walls.back().from);
  EXPECT_EQ(kept.sigma_m, 0.04);
  EXPECT_FALSE(refined.plan.walls.front().sigma_m.has_value());
  EXPECT_LT(refined.plan.sigma_m, 0.01);
}

}  // namespace
}  // namespace cornerd::survey
