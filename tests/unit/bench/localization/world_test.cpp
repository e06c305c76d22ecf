// SPDX-License-Identifier: MIT
#include "bench/localization/world.hpp"

#include <gtest/gtest.h>

#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

using replay::two_rooms;

TEST(World, Obstacle_RangeEndsAtItsSurface) {
  const std::vector<RoundObstacle> obstacles = {{{2, 0}, 0.25}};
  EXPECT_NEAR(range_with_obstacles(obstacles, {0, 0}, 0, 5), 1.75, 1e-12);
  EXPECT_NEAR(range_with_obstacles(obstacles, {0, 0}, 0, 0), 1.75, 1e-12);
  EXPECT_EQ(range_with_obstacles(obstacles, {0, 0}, 0, 1), 1);
  EXPECT_EQ(range_with_obstacles(obstacles, {0, 0}, core::kPi, 5), 5);
}

TEST(World, Clutter_StopsRequestedShare) {
  const auto map = replay::make_room();
  replay::Random random(3);
  const core::Vec2 place(1.2, 1.1);
  const auto obstacles = clutter_around(*map, place, 0.3, random);
  int stopped = 0;
  for (int i = 0; i < 3600; ++i) {
    const double angle_rad = core::radians(0.1 * i);
    const double range_m = map->range_along(place, angle_rad, 100);
    stopped += range_with_obstacles(obstacles, place, angle_rad, range_m) < range_m ? 1 : 0;
  }
  EXPECT_GT(stopped, 0.29 * 3600);
  EXPECT_LT(stopped, 0.6 * 3600);
}

TEST(World, ClosedDoor_StopsRays) {
  const auto plans = with_a_door_closed(two_rooms());
  ASSERT_EQ(plans.size(), 1u);
  const core::WallMap closed(plans.front());
  EXPECT_NEAR(closed.range_along({1, 1}, 0, 10), 0.95, 1e-9);
  EXPECT_NEAR(two_rooms().range_along({1, 1}, 0, 10), 2.95, 1e-9);
}

TEST(World, DisplacedWall_OnePlanPerWall) {
  const auto plans = with_a_wall_displaced(two_rooms(), 0.03);
  ASSERT_EQ(plans.size(), 6u);
  EXPECT_NEAR(core::WallMap(plans[0]).range_along({1, 1}, -core::kPi / 2, 10), 0.95 - 0.03, 1e-9);
  EXPECT_NEAR(core::WallMap(plans[1]).range_along({1, 1}, -core::kPi / 2, 10), 0.95, 1e-9);
}

}  // namespace
}  // namespace cornerd::bench
