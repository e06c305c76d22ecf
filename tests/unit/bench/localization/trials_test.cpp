// SPDX-License-Identifier: MIT
#include "bench/localization/trials.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/building.hpp"
#include "bench/localization/kidnapping.hpp"
#include "bench/localization/world.hpp"
#include "core/breakpoint/detector.hpp"
#include "core/localizer.hpp"
#include "core/recognition/place_search.hpp"
#include "replay/simulator/random_poses.hpp"
#include "replay/simulator/scan_simulator.hpp"
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

// Where walls had been exact, a room that few rays refined badly fitted worse than the one that
// was fitted by all: of this scan a room nine rooms away was named.
TEST(Trials, EqualRoomsOfExactWalls_AreAllCompared) {
  const core::WallMap map(equal_rooms(12));
  const core::LocalizerConfig config;
  const core::Pose2 truth{36.148391, 5.549806, 0.587625};
  replay::ScanSimulator lidar({}, 800, 22822, 137'000'000);
  core::PolarScan points;
  points.assign(lidar.take(0,
                           [&](core::TimeNs, double bearing_rad) {
                             return map.range_along(truth.translation(),
                                                    truth.theta_rad + bearing_rad,
                                                    replay::ScanSimulator::kMaxRange_m);
                           }),
                config.min_range_m, config.max_range_m);
  core::Detector detector(config.detector, config.noise);
  core::Detection detection;
  detector.detect(points, detection);
  const core::Catalog catalog(map, config.max_range_m);
  core::Recognition recognition(catalog);
  core::PlaceSearch search(map, recognition, config);
  search.begin(points, detection.segments, detection.breakpoints,
               {.noise_scale = detection.noise_scale,
                .max_map_sigma_m = core::BeamModel::kMapSigmas_m.front()});
  search.consider(recognition.from_pairs(detection.breakpoints));
  const auto found = search.find();
  EXPECT_GE(found.size(), 10u);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const core::VerifiedHypothesis& place) {
    return core::same_pose(place.refined.T_map_lidar, truth, 0.01, 0.01);
  }));
}

TEST(Trials, TurningAmongManyEqualRooms_NoneIsNamedInAnother) {
  const auto map = std::make_shared<const core::WallMap>(equal_rooms(40));
  const CircularMotion motion{0.1, 1.5};
  for (const std::uint64_t drive : {3, 5, 14, 15}) {
    const replay::Motion circle = circling(random_circles(*map, motion, 1, drive).front(), motion);
    replay::ScanSimulator lidar({}, 540, drive);
    core::Localizer localizer(map, {});
    core::TimeNs t_ns = 0;
    for (int k = 0; k < 60; ++k, t_ns += lidar.scan_ns()) {
      const core::PoseEstimate& pose = localizer.step(lidar.take(*map, t_ns, circle)).pose;
      if (!core::has_pose(pose.state)) continue;
      const core::Pose2 truth = circle(pose.t_ns, 0);
      EXPECT_TRUE(core::same_pose(pose.T_map_base, truth, 0.15, 0.15)) << drive << " " << k;
    }
  }
}

}  // namespace
}  // namespace cornerd::bench
