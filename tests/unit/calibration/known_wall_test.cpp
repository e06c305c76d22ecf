// SPDX-License-Identifier: MIT
#include "calibration/known_wall.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.hpp"
#include "static_room.hpp"

namespace cornerd::calibration {
namespace {

// The walls of the room stand 0.4, 2, 5.6 and 7 m away.
StaticRoom noisy_room(int scans) {
  StaticRoom room;
  room.scans = scans;
  room.sigma_m = [](double) { return 0.003; };
  return room;
}

TEST(KnownWall, EveryWallOfARoom_IsFoundByItsDistance) {
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

TEST(KnownWall, Bias_StaysInTheErrors) {
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

TEST(KnownWall, DistanceWithoutWall_IsNone) {
  const std::vector<Return> returns = noisy_room(5).record().all();
  EXPECT_FALSE(find_known_wall(returns, 11).has_value());
  EXPECT_FALSE(find_known_wall({}, 1).has_value());
}

}  // namespace
}  // namespace cornerd::calibration
