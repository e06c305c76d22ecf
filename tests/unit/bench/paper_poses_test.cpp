// SPDX-License-Identifier: MIT
#include "bench/paper_poses.hpp"

#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "bench/corner_experiment.hpp"
#include "bench/paper_experiment.hpp"
#include "replay/simulator/random_poses.hpp"
#include "tests/unit/bench/contest_maps.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

TEST(PaperPlaces, EachRoom_HasThePapersCount) {
  const auto maps = contest_maps();
  const auto poses = paper_poses(maps);
  ASSERT_EQ(poses.size(), 43u);
  std::array<std::size_t, kPaperLocations.size()> counts{};
  for (const PaperPose& place : poses) {
    ++counts[place.location];
    const core::WallMap& map = *maps[place.map];
    const core::Vec2 point = place.T_map_lidar.translation();
    const auto room = map.room_at(point);
    ASSERT_TRUE(room);
    EXPECT_EQ(map.plan().rooms[*room].name, kPaperLocations[place.location].room);
    EXPECT_FALSE(map.is_solid(point));
    EXPECT_GE(replay::clearance_at(map, point), kClearance_m);
  }
  EXPECT_EQ(counts, (std::array<std::size_t, 5>{9, 8, 10, 8, 8}));
}

TEST(PaperPlaces, Layouts_AreUsedInRotation) {
  std::array<std::size_t, 4> counts{};
  for (const PaperPose& place : paper_poses(contest_maps())) ++counts[place.map];
  for (const std::size_t count : counts) EXPECT_GE(count, 10u);
}

TEST(PaperPlaces, PosesOfARoom_AreApart) {
  const auto poses = paper_poses(contest_maps());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t j = i + 1; j < poses.size(); ++j) {
      const core::Vec2 way =
          poses[i].T_map_lidar.translation() - poses[j].T_map_lidar.translation();
      EXPECT_GT(way.norm(), 0.02) << i << " and " << j;
    }
  }
}

TEST(PaperPlaces, MapWithoutRooms_Throws) {
  const std::vector maps = {replay::make_room()};
  EXPECT_THROW(paper_poses(maps), std::runtime_error);
}

}  // namespace
}  // namespace cornerd::bench
