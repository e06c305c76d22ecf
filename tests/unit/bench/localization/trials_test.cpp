// SPDX-License-Identifier: MIT
#include "bench/localization/trials.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/localization/kidnapping.hpp"
#include "replay/simulator/random_poses.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

/// A room without any symmetry.
std::shared_ptr<const core::WallMap> odd_room() {
  core::FloorPlan plan;
  plan.walls = {{{0, 0}, {3, 0}, 0},     {{3, 0}, {3, 1.4}, 0},   {{3, 1.4}, {2, 1.4}, 0},
                {{2, 1.4}, {2, 2.5}, 0}, {{2, 2.5}, {0, 2.5}, 0}, {{0, 2.5}, {0, 0}, 0}};
  return std::make_shared<const core::WallMap>(plan);
}

Trial in_a_room() {
  const auto map = odd_room();
  Trial trial;
  trial.title = "room";
  trial.buildings = {{map, {map}}};
  return trial;
}

TEST(Trials, StandingRobot_ErrorNearBound) {
  const PoseScore score = run_trial(in_a_room(), 20, 1);
  EXPECT_EQ(score.scans(), 20u);
  EXPECT_EQ(score.wrong(), 0u);
  ASSERT_GT(score.named(), 15u);
  EXPECT_GT(score.rmse_over_bound(), 0.5);
  EXPECT_LT(score.rmse_over_bound(), 2);
}

TEST(Trials, WorldOtherThanMap_LidarSeesWorld) {
  Trial trial = in_a_room();
  core::FloorPlan larger = trial.buildings.front().map->plan();
  for (core::Wall& wall : larger.walls) {
    wall.from *= 1.5;
    wall.to *= 1.5;
  }
  trial.buildings.front().worlds = {std::make_shared<const core::WallMap>(larger)};
  EXPECT_EQ(run_trial(trial, 10, 1).named(), 0u);
}

TEST(Trials, MovingRobot_IsTrackedOnItsCircle) {
  Trial trial = in_a_room();
  trial.motion = {0.1, 1};
  trial.scans_each = 8;
  trial.odometry = true;
  const PoseScore score = run_trial(trial, 3, 1);
  EXPECT_EQ(score.scans(), 24u);
  EXPECT_GT(score.named(), 20u);
  EXPECT_EQ(score.wrong(), 0u);
}

TEST(Circle, Motion_ReturnsAndKeepsClearance) {
  const auto map = replay::make_room();
  const CircularMotion motion{0.2, 1};
  for (const core::Pose2& start : random_circles(*map, motion, 5, 1)) {
    const replay::Motion robot = circling(start, motion);
    for (int i = 0; i <= 20; ++i) {
      const auto t_ns = static_cast<core::TimeNs>(core::kTwoPi * 1e9 * i / 20);
      EXPECT_GT(replay::clearance_at(*map, robot(t_ns, 0).translation()), 0.13);
    }
    const core::Pose2 after = robot(static_cast<core::TimeNs>(core::kTwoPi * 1e9), 0);
    EXPECT_NEAR((after.translation() - start.translation()).norm(), 0, 1e-6);
  }
}

TEST(Circle, RoomTooSmall_Throws) {
  EXPECT_THROW(random_circles(*replay::make_room(), {5, 1}, 1, 1), std::runtime_error);
}

TEST(Kidnapping, EachJump_IsCountedOnce) {
  const KidnappingScore score = run_kidnapping({odd_room()}, 10, 1);
  EXPECT_EQ(score.jumps, 10u);
  std::size_t sum = score.never;
  for (const std::size_t count : score.recovered) sum += count;
  EXPECT_EQ(sum, 10u);
  EXPECT_EQ(score.wrong_later, 0u);
}

}  // namespace
}  // namespace cornerd::bench
