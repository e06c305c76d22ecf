// SPDX-License-Identifier: MIT
#include "bench/building.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "replay/simulator/random_poses.hpp"

namespace cornerd::bench {
namespace {

TEST(OfficeBuilding, CornerCount_MatchesRequest) {
  for (const double corners : {200.0, 2000.0, 20'000.0}) {
    const core::WallMap map(office_building(static_cast<std::size_t>(corners), 1));
    EXPECT_NEAR(static_cast<double>(map.corners().size()), corners, 0.15 * corners);
  }
  EXPECT_LT(core::WallMap(office_building(20, 1)).corners().size(), 40U);
}

TEST(OfficeBuilding, FreePose_IsInsideARoom) {
  const core::WallMap map(office_building(300, 2));
  EXPECT_GT(map.plan().rooms.size(), 20U);
  for (const core::Pose2& place : replay::random_poses(map, 50, 0.3, 3)) {
    EXPECT_TRUE(map.room_at(place.translation()));
  }
}

TEST(OfficeBuilding, SameSeed_SameBuilding) {
  const auto one = office_building(500, 4);
  const auto same = office_building(500, 4);
  const auto other = office_building(500, 5);
  ASSERT_EQ(one.walls.size(), same.walls.size());
  for (std::size_t i = 0; i < one.walls.size(); ++i) {
    EXPECT_EQ(one.walls[i].from, same.walls[i].from);
    EXPECT_EQ(one.walls[i].to, same.walls[i].to);
  }
  EXPECT_NE(one.walls[3].to, other.walls[3].to);
}

TEST(EqualRooms, SameSpotInEachRoom_SameRanges) {
  const core::WallMap map(equal_rooms(5));
  const core::Vec2 place(1.1, 3.3);
  for (int i = 0; i < 360; ++i) {
    const double range_m = map.range_along(place, core::radians(i + 0.3), 3);
    EXPECT_NEAR(map.range_along(place + core::Vec2(7, 0), core::radians(i + 0.3), 3), range_m,
                1e-6);
  }
}

TEST(LongCorridor, AnySeed_IsClosed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const core::WallMap map(long_corridor(seed));
    for (int degrees = 0; degrees < 360; ++degrees) {
      EXPECT_LT(map.range_along({1, 0.6}, core::radians(degrees + 0.5), 100), 99) << seed;
    }
  }
}

}  // namespace
}  // namespace cornerd::bench
