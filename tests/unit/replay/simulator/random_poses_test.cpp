// SPDX-License-Identifier: MIT
#include "replay/simulator/random_poses.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "settings/map_file.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

TEST(RandomPoses, AllPoses_AreIndoorsWithClearance) {
  const auto map =
      settings::load_map(std::string(CORNERD_SOURCE_DIR) + "/config/maps/krpai-2019-a.json");
  const auto poses = random_poses(*map, 100, 0.2, 1);
  ASSERT_EQ(poses.size(), 100u);
  for (const core::Pose2& pose : poses) {
    EXPECT_FALSE(map->is_solid(pose.translation()));
    EXPECT_GE(clearance_at(*map, pose.translation()), 0.2);
    EXPECT_GT(pose.x_m, 0.2);
    EXPECT_LT(pose.x_m, 2.2);
    EXPECT_GT(pose.y_m, 0.2);
    EXPECT_LT(pose.y_m, 2.2);
  }
}

TEST(RandomPoses, RegionOutsideTheWalls_HasNoPoses) {
  core::FloorPlan plan;  // A small closed room, and an isolated wall far away.
  plan.walls = {{{0, 0}, {2, 0}, 0},
                {{2, 0}, {2, 2}, 0},
                {{2, 2}, {0, 2}, 0},
                {{0, 2}, {0, 0}, 0},
                {{6, 0}, {6, 2}, 0}};
  const core::WallMap map(plan);
  for (const core::Pose2& pose : random_poses(map, 50, 0.1, 2)) EXPECT_LT(pose.x_m, 2);
}

TEST(RandomPoses, SameSeed_GivesTheSamePoses) {
  const auto map = make_room();
  const auto once = random_poses(*map, 5, 0.2, 9);
  const auto again = random_poses(*map, 5, 0.2, 9);
  const auto other = random_poses(*map, 5, 0.2, 10);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(once[i].x_m, again[i].x_m);
    EXPECT_EQ(once[i].theta_rad, again[i].theta_rad);
    EXPECT_NE(once[i].x_m, other[i].x_m);
  }
}

TEST(RandomPoses, TooLargeClearance_Throws) {
  EXPECT_THROW(random_poses(*make_room(), 1, 1.5, 1), std::runtime_error);
}

TEST(ClearanceAt, AnyPoint_IsDistanceToNearestWall) {
  EXPECT_DOUBLE_EQ(clearance_at(*make_room(), {0.5, 1.0}), 0.5);
  EXPECT_DOUBLE_EQ(clearance_at(*make_room(), {-3, -4}), 5);
}

}  // namespace
}  // namespace cornerd::replay
