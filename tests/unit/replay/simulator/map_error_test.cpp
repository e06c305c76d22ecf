// SPDX-License-Identifier: MIT
#include "replay/simulator/map_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

using core::Vec2;

TEST(MapError, DisplacementOfManyWalls_HasItsStandardDeviation) {
  constexpr int kWalls = 2000;
  constexpr double kSigma_m = 0.04;
  core::FloorPlan plan;
  for (int i = 0; i < kWalls; ++i) {
    const Vec2 from(3.0 * i, 0);
    plan.walls.push_back({from, from + core::unit_vector(0.1 * i), 0.1});
  }
  const core::FloorPlan changed = with_map_error(plan, kSigma_m, 7);
  double sum = 0;
  double sum_of_squares = 0;
  for (int i = 0; i < kWalls; ++i) {
    const core::Wall& wall = plan.walls[i];
    const Vec2 moved = changed.walls[i].from - wall.from;
    EXPECT_LT((changed.walls[i].to - wall.to - moved).norm(), 1e-9);
    EXPECT_NEAR(moved.dot(wall.to - wall.from), 0, 1e-9);
    const double by = core::cross(wall.to - wall.from, moved) / kSigma_m;
    sum += by;
    sum_of_squares += by * by;
  }
  // 99.9 %, two-sided: normal, and chi-square of 2000 degrees of freedom.
  EXPECT_LT(std::abs(sum), 3.29 * std::sqrt(kWalls));
  EXPECT_GT(sum_of_squares, 1799);
  EXPECT_LT(sum_of_squares, 2216);
}

TEST(MapError, WallsThatMeet_StillMeet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const core::FloorPlan plan = with_map_error(make_room()->plan(), 0.1, seed);
    for (int i = 0; i < 4; ++i) {
      EXPECT_LT((plan.walls[i].to - plan.walls[(i + 1) % 4].from).norm(), 1e-9);
    }
    const core::WallMap room(plan);
    for (int i = 0; i < 360; ++i) EXPECT_GT(room.range_along({1, 1.5}, core::radians(i), 10), 0);
  }
}

TEST(MapError, OtherSeed_MovesWallsElsewhere) {
  const core::FloorPlan plan = make_room()->plan();
  const core::FloorPlan changed = with_map_error(plan, 0.05, 1);
  EXPECT_EQ(changed.walls[0].from, with_map_error(plan, 0.05, 1).walls[0].from);
  EXPECT_NE(changed.walls[0].from, with_map_error(plan, 0.05, 2).walls[0].from);
  EXPECT_EQ(plan.walls[0].from, with_map_error(plan, 0, 1).walls[0].from);
}

TEST(MapError, NegativeSigma_IsRefused) {
  EXPECT_THROW(with_map_error(make_room()->plan(), -0.1, 1), std::invalid_argument);
  EXPECT_THROW(with_map_error(make_room()->plan(), std::nan(""), 1), std::invalid_argument);
}

TEST(MapError, EndsOff_TurnWallsAndKeepThemTogether) {
  constexpr double kSigma_m = 0.04;
  const core::FloorPlan plan = make_room()->plan();
  double sum_of_squares = 0;
  for (std::uint64_t seed = 0; seed < 250; ++seed) {
    const core::FloorPlan changed = with_end_error(plan, kSigma_m, seed);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(changed.walls[i].to, changed.walls[(i + 1) % 4].from);
      sum_of_squares +=
          (changed.walls[i].to - plan.walls[i].to).squaredNorm() / (kSigma_m * kSigma_m);
    }
  }
  // 99.9 %, two-sided: chi-square of 2000 degrees of freedom.
  EXPECT_GT(sum_of_squares, 1799);
  EXPECT_LT(sum_of_squares, 2216);
  EXPECT_EQ(with_end_error(plan, 0, 1).walls[0].from, plan.walls[0].from);
  EXPECT_THROW(with_end_error(plan, -0.1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace cornerd::replay
