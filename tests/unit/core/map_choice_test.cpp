// SPDX-License-Identifier: MIT
#include "core/map_choice.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "fixtures.hpp"

namespace cornerd::core {
namespace {

using Maps = std::vector<std::shared_ptr<const WallMap>>;

constexpr double kStep_m = 0.03;

/// A robot that drives to and fro along the L-shaped room's lower side.
struct DrivingRobot {
  std::shared_ptr<const WallMap> room;
  testing::ScanSource source{81};
  int scans = 0;
  Pose2 truth = {};

  Scan next() {
    constexpr int kWay = 100;
    const int at = scans % (2 * kWay);
    truth = {0.5 + kStep_m * (at < kWay ? at : 2 * kWay - at), 0.6, 0.2};
    testing::ScanOptions options;
    options.start_ns = TimeNs{137'000'000} * scans++;
    return source.take(*room, truth, options);
  }
};

/// The L-shaped room, and one whose upper part is narrower.
Maps two_rooms() {
  FloorPlan other = testing::l_shaped_room();
  for (Wall& wall : other.walls) {
    for (Vec2* end : {&wall.from, &wall.to}) {
      if (end->y() > 1.5) end->x() *= 0.7;
    }
  }
  return {testing::make_map(testing::l_shaped_room()), testing::make_map(std::move(other))};
}

TEST(MapChoice, OneMap_KnownFromTheStart) {
  const Maps maps = {testing::make_map(testing::l_shaped_room())};
  DrivingRobot robot{maps.front()};
  MapChoice choice(maps, {});
  EXPECT_EQ(choice.map(), 0U);
  EXPECT_EQ(choice.step(robot.next()).pose.state, PoseState::kFix);
}

TEST(MapChoice, SearchesThatDoNotEnd_ComparisonGoesOn) {
  LocalizerConfig config;
  config.search_nodes_per_scan = 1;
  const Maps maps = two_rooms();
  DrivingRobot robot{maps[0]};
  MapChoice choice(maps, config);
  int scans = 0;
  while (!choice.map() && ++scans < 3000) choice.step(robot.next());
  EXPECT_EQ(choice.map(), 0U) << scans;
}

TEST(MapChoice, Drive_NamesItsMapAndGoesOnWithoutALostPose) {
  const Maps maps = two_rooms();
  for (std::size_t map = 0; map < maps.size(); ++map) {
    DrivingRobot robot{maps[map]};
    MapChoice choice(maps, {});
    while (!choice.map() && robot.scans < 200) {
      const PoseEstimate& pose = choice.step(robot.next()).pose;
      if (choice.map()) {
        EXPECT_TRUE(has_pose(pose.state)) << "the scan that names it has a pose";
        break;
      }
      EXPECT_TRUE(pose.state == PoseState::kAmbiguous || pose.state == PoseState::kLost);
    }
    ASSERT_EQ(choice.map(), map);
    for (int i = 0; i < 20; ++i) {
      const PoseEstimate& pose = choice.step(robot.next()).pose;
      ASSERT_TRUE(has_pose(pose.state));
      EXPECT_LT((pose.T_map_base.translation() - robot.truth.translation()).norm(), 0.02);
    }
  }
}

TEST(MapChoice, EqualMaps_AmbiguousWithBoth) {
  const auto room = testing::make_map(testing::l_shaped_room());
  const Maps maps = {room, room, two_rooms()[1]};
  DrivingRobot robot{room};
  MapChoice choice(maps, {});
  const PoseEstimate* pose = nullptr;
  for (int i = 0; i < 300; ++i) pose = &choice.step(robot.next()).pose;
  EXPECT_FALSE(choice.map());
  EXPECT_EQ(pose->state, PoseState::kAmbiguous);
  ASSERT_EQ(pose->alternatives.size(), 2U);
  EXPECT_NEAR(pose->alternatives[0].score, 0.5, 0.01);
  EXPECT_NE(pose->alternatives[0].map, 2U);
  EXPECT_NE(pose->alternatives[1].map, 2U);
  // The pose holds for its time: that of the scan that was compared last.
  EXPECT_LT(pose->t_ns, TimeNs{137'000'000} * robot.scans);
  EXPECT_GT(pose->t_ns, TimeNs{137'000'000} * (robot.scans - 6));
}

TEST(MapChoice, Relocalize_ChoosesAgain) {
  const Maps maps = two_rooms();
  DrivingRobot robot{maps[0]};
  MapChoice choice(maps, {});
  while (!choice.map() && robot.scans < 200) choice.step(robot.next());
  ASSERT_EQ(choice.map(), 0U);
  robot.room = maps[1];
  choice.relocalize();
  EXPECT_FALSE(choice.map());
  for (int i = 0; i < 200 && !choice.map(); ++i) choice.step(robot.next());
  EXPECT_EQ(choice.map(), 1U);
}

TEST(MapChoice, ChosenMap_GoesOnWithTheOdometry) {
  const Maps maps = two_rooms();
  LocalizerConfig config;
  config.odometry.enabled = true;
  DrivingRobot robot{maps[0]};
  MapChoice choice(maps, config);
  std::uint64_t readings = 0;
  const auto drive_until_known = [&] {
    do {
      OdometryReading reading;
      reading.t_ns = TimeNs{137'000'000} * robot.scans + 1;
      reading.left = reading.right = 300 * robot.scans;
      choice.localizer().add(reading);
      ++readings;
      EXPECT_EQ(choice.step(robot.next()).odometry.counters.readings, readings);
    } while (!choice.map() && robot.scans < 400);
  };
  drive_until_known();
  ASSERT_EQ(choice.map(), 0U);
  choice.relocalize();
  drive_until_known();
  EXPECT_EQ(choice.map(), 0U);
}

}  // namespace
}  // namespace cornerd::core
