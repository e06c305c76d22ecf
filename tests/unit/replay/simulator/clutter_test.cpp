// SPDX-License-Identifier: MIT
#include "replay/simulator/clutter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "replay/simulator/doors.hpp"
#include "replay/simulator/random_poses.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::replay {
namespace {

using core::Vec2;

constexpr double kRate_hz = 7.3;

/// Through the door of two_rooms() and back.
Motion drive() { return drive_path({{0.5, 1}, {3.5, 1}, {3, 0.6}}, {}); }
constexpr std::int64_t kDriveScans = 160;

core::WallMap with(const core::WallMap& map, const Clutter& clutter) {
  core::FloorPlan plan = map.plan();
  plan.walls.insert(plan.walls.end(), clutter.walls.begin(), clutter.walls.end());
  return core::WallMap(plan);
}

/// Share of the rays along the motion that the world stops before the map does.
double share_stopped(const core::WallMap& map, const core::WallMap& world, const Motion& motion,
                     std::int64_t scans, double width_rad) {
  constexpr int kRays = 500;
  int stopped = 0;
  for (std::int64_t scan = 0; scan < scans; ++scan) {
    const core::Pose2 pose =
        motion(core::from_seconds((static_cast<double>(scan) + 0.5) / kRate_hz), scan);
    for (int i = 0; i < kRays; ++i) {
      const double angle_rad = pose.theta_rad + width_rad * ((i + 0.5) / kRays - 0.5);
      const double free_m = map.range_along(pose.translation(), angle_rad, 12);
      const double range_m = world.range_along(pose.translation(), angle_rad, 12);
      stopped += range_m < free_m - 1e-6 ? 1 : 0;
    }
  }
  return stopped / static_cast<double>(kRays * scans);
}

TEST(Clutter, Share_IsReachedWithinThreePoints) {
  const core::WallMap map = two_rooms();
  SensorModel quarter;
  quarter.field_of_view.width_rad = core::kPi / 2;
  for (const SensorModel& sensor : {SensorModel(), quarter}) {
    for (const double share : {0.1, 0.3, 0.5}) {
      const Clutter clutter =
          place_clutter(map, scanned_path(drive(), {}, kDriveScans, kRate_hz), sensor, share, 5);
      EXPECT_GE(clutter.share, share);
      EXPECT_LE(clutter.obstacles, clutter.walls.size());
      const double stopped = share_stopped(map, with(map, clutter), drive(), kDriveScans,
                                           sensor.field_of_view.width_rad);
      EXPECT_NEAR(stopped, share, 0.03);
      EXPECT_NEAR(stopped, clutter.share, 0.02);
    }
  }
}

TEST(Clutter, Obstacles_KeepClearOfRobotAndLidar) {
  const core::WallMap map = two_rooms();
  const core::Pose2 T_base_lidar{0.1, 0, 0};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    core::FloorPlan plan;
    plan.walls = place_clutter(map, scanned_path(drive(), T_base_lidar, kDriveScans, kRate_hz), {},
                               0.3, seed)
                     .walls;
    const core::WallMap obstacles(plan);
    for (int i = 0; i < 5000; ++i) {
      const core::Pose2 pose = drive()(core::from_seconds(i * 0.005), 0);
      for (const core::Pose2& at : {pose, pose * T_base_lidar}) {
        ASSERT_FALSE(obstacles.is_solid(at.translation()));
        ASSERT_GT(clearance_at(obstacles, at.translation()), kClutterClearance_m - 1e-3);
      }
    }
  }
}

TEST(Clutter, Obstacles_StandInFreeSpaceButForDoors) {
  const core::WallMap map = two_rooms();
  const core::Wall door = doors_of(map).front();
  const ScannedPath path = scanned_path(stand_still({0.6, 0.6, 0}), {}, 1, kRate_hz);
  int closed = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    for (const core::Wall& wall : place_clutter(map, path, {}, 0.4, seed).walls) {
      if (wall.from == door.from && wall.to == door.to) {
        ++closed;
        continue;
      }
      for (const Vec2& point : {wall.from, wall.to}) {
        EXPECT_FALSE(map.is_solid(point));
        EXPECT_GT(clearance_at(map, point), wall.thickness_m / 2);
      }
    }
  }
  EXPECT_GT(closed, 0);
}

TEST(Clutter, SameSeed_SameObstacles) {
  const core::WallMap map = two_rooms();
  const ScannedPath path = scanned_path(drive(), {}, kDriveScans, kRate_hz);
  const auto first = [&](std::uint64_t seed) {
    return place_clutter(map, path, {}, 0.2, seed).walls.front().from;
  };
  EXPECT_EQ(first(1), first(1));
  EXPECT_NE(first(1), first(2));
}

TEST(Clutter, NoRoom_IsAnErrorWithTheShareReached) {
  core::FloorPlan cell;
  cell.walls = {{{0, 0}, {0.5, 0}, 0.02},
                {{0.5, 0}, {0.5, 0.5}, 0.02},
                {{0.5, 0.5}, {0, 0.5}, 0.02},
                {{0, 0.5}, {0, 0}, 0.02}};
  const ScannedPath path = scanned_path(stand_still({0.25, 0.25, 0}), {}, 1, kRate_hz);
  try {
    place_clutter(core::WallMap(cell), path, {}, 0.5, 1);
    FAIL() << "there is no room";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("% of the rays, not 50 %"));
    EXPECT_THAT(error.what(), testing::HasSubstr("choose a smaller share"));
  }
  EXPECT_THROW(place_clutter(core::WallMap(cell), path, {}, 1.1, 1), std::invalid_argument);
  EXPECT_THROW(place_clutter(core::WallMap(cell), {}, {}, 0.1, 1), std::invalid_argument);
}

TEST(ScannedPath, RandomPlaces_HaveNoPointsBetweenThem) {
  const Motion visits = visit_poses({{0, 0, 0}, {5, 0, 1}}, 10);
  const ScannedPath path = scanned_path(visits, {}, 20, kRate_hz);
  EXPECT_EQ(path.T_map_lidar.size(), 20u);
  for (const Vec2& point : path.points) EXPECT_TRUE(point.x() == 0 || point.x() == 5);
  EXPECT_EQ(path.points.size(), 4u);
  EXPECT_THROW(scanned_path(visits, {}, 0, kRate_hz), std::invalid_argument);
}

TEST(Doors, GapBetweenWallEnds_IsADoor) {
  const auto doors = doors_of(two_rooms());
  ASSERT_EQ(doors.size(), 1u);
  EXPECT_NEAR((doors[0].from + doors[0].to).y() / 2, 1.05, 0.06);
}

}  // namespace
}  // namespace cornerd::replay
