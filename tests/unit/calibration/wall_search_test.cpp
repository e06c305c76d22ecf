// SPDX-License-Identifier: MIT
#include "calibration/wall_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"
#include "static_room.hpp"

namespace cornerd::calibration {
namespace {

std::vector<KnownWall> walls_of(const BearingBins& bins) {
  std::vector<KnownWall> walls = find_walls(bins.spreads(), bins.all());
  std::sort(walls.begin(), walls.end(),
            [](const auto& a, const auto& b) { return a.distance_m < b.distance_m; });
  return walls;
}

TEST(FindWalls, RoomWithFourWalls_GivesTheirDistances) {
  StaticRoom room;
  room.sigma_m = [](double) { return 0.003; };
  const std::vector<KnownWall> walls = walls_of(room.record());
  ASSERT_EQ(walls.size(), 4u);
  const std::pair<double, double> expected[] = {
      {0.4, -core::kPi / 2}, {2, core::kPi}, {5.6, core::kPi / 2}, {7, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(walls[i].distance_m, expected[i].first, 0.002);
    EXPECT_NEAR(core::angle_between(walls[i].bearing_rad, expected[i].second), 0, 0.002);
    EXPECT_GT(walls[i].returns.size(), 1000u);
  }
}

TEST(FindWalls, ErrorsDependingOnRay_AreKept) {
  // Ranges are too long on both sides of the normal, as in the paper's polynomials.
  StaticRoom room;
  room.sigma_m = [](double) { return 0.001; };
  BearingBins bent;
  for (const Return& each : room.record().all()) {
    const double ray = core::angle_between(-core::kPi / 2, each.bearing_rad);
    const bool on_it = std::abs(each.range_m * std::cos(ray) - 0.4) < 0.02;
    bent.add(each.bearing_rad, each.range_m + (on_it ? 0.008 * ray * ray : 0));
  }
  const std::vector<KnownWall> walls = walls_of(bent);
  ASSERT_FALSE(walls.empty());
  double near_m = 0;
  double aside_m = 0;
  int near_count = 0;
  int aside_count = 0;
  for (const WallReturn& each : walls[0].returns) {
    if (std::abs(each.ray_rad) < 0.2) {
      near_m += each.error_m;
      ++near_count;
    } else if (std::abs(each.ray_rad) > 0.9) {
      aside_m += each.error_m;
      ++aside_count;
    }
  }
  ASSERT_GT(near_count, 50);
  ASSERT_GT(aside_count, 50);
  EXPECT_GT(aside_m / aside_count - near_m / near_count, 0.001);
}

TEST(FindWalls, NoBins_GiveNoWalls) { EXPECT_TRUE(find_walls({}, {}).empty()); }

TEST(FindWalls, RoundRoom_GivesNoWalls) {
  BearingBins bins;
  for (int i = 0; i < 30 * 300; ++i) {
    bins.add(core::kTwoPi * i / 300.37, 2 + 0.001 * std::sin(12.9898 * i));
  }
  EXPECT_TRUE(walls_of(bins).empty());
}

// The walls of the room are 0.4, 2, 5.6 and 7 m away.
StaticRoom noisy_room(int scans) {
  StaticRoom room;
  room.scans = scans;
  room.sigma_m = [](double) { return 0.003; };
  return room;
}

TEST(FindKnownWall, EachWallOfRoom_IsFoundByItsDistance) {
  const std::vector<Return> returns = noisy_room(5).record().all();
  const std::pair<double, double> walls[] = {
      {0.4, -core::kPi / 2}, {2, core::kPi}, {5.6, core::kPi / 2}, {7, 0}};
  for (const auto& [distance_m, bearing_rad] : walls) {
    const auto wall = find_known_wall(returns, distance_m);
    ASSERT_TRUE(wall.has_value()) << distance_m;
    EXPECT_NEAR(core::angle_between(wall->bearing_rad, bearing_rad), 0, 0.003) << distance_m;
    EXPECT_NEAR(wall->measured_m, distance_m, 0.002);
    for (const WallReturn& each : wall->returns) EXPECT_LT(std::abs(each.ray_rad), 1.23);
  }
}

TEST(FindKnownWall, RangeBias_StaysInErrors) {
  const StaticRoom room = noisy_room(10);
  BearingBins biased;
  for (const Return& each : room.record().all()) biased.add(each.bearing_rad, each.range_m + 0.012);
  const auto wall = find_known_wall(biased.all(), 2);
  ASSERT_TRUE(wall.has_value());
  EXPECT_NEAR(wall->measured_m, 2.012, 0.002);
  EXPECT_NEAR(core::angle_between(wall->bearing_rad, core::kPi), 0, 0.003);
  double sum_m = 0;
  for (const WallReturn& each : wall->returns) sum_m += each.error_m;
  EXPECT_NEAR(sum_m / static_cast<double>(wall->returns.size()), 0.012, 0.001);
}

TEST(FindKnownWall, DistanceWithoutWall_GivesNullopt) {
  const std::vector<Return> returns = noisy_room(5).record().all();
  EXPECT_FALSE(find_known_wall(returns, 11).has_value());
  EXPECT_FALSE(find_known_wall({}, 1).has_value());
}

}  // namespace
}  // namespace cornerd::calibration
