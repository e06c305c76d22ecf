// SPDX-License-Identifier: MIT
#include "survey/odometry_doubt.hpp"

#include <gtest/gtest.h>

namespace cornerd::survey {
namespace {

/// 2 m straight ahead in 20 turns of 0.1 s; 1 m by a count, the right wheel's wrap at 10.
TEST(MeasureWheels, DeadWheel_IsToldByItsWay) {
  core::OdometryConfig config;
  config.geometry.wheel_radius_m = 1 / core::kTwoPi;
  config.geometry.counts_per_turn = 10;
  config.geometry.ceiling = 9;
  RecordedDrive drive;
  std::vector<core::Pose2> way;
  for (int i = 0; i <= 20; ++i) {
    core::OdometryReading reading;
    reading.t_ns = i * 100'000'000;
    reading.left = 3;
    reading.right = i % 10;
    drive.add(reading, reading.t_ns);
    way.push_back({0.1 * i, 0, 0});
  }
  OdometryDoubt doubt;
  measure_wheels(drive, way, config, doubt);
  EXPECT_NEAR(doubt.left.counted_m, 0, 1e-12);
  EXPECT_NEAR(doubt.right.counted_m, 2, 1e-9);
  EXPECT_NEAR(doubt.left.true_m, 2, 1e-9);
  EXPECT_NEAR(doubt.right.true_m, 2, 1e-9);
}

TEST(MeasureWheels, Turn_RollsThemByTheTrack) {
  core::OdometryConfig config;
  config.geometry.track_m = 0.2;
  const std::vector<core::Pose2> way = {{}, {0, 0, 1}};
  OdometryDoubt doubt;
  measure_wheels({}, way, config, doubt);
  EXPECT_NEAR(doubt.left.true_m, 0.1, 1e-12);
  EXPECT_NEAR(doubt.right.true_m, 0.1, 1e-12);
}

TEST(AreTooMany, TenthOfTheTurns_IsNot) {
  EXPECT_FALSE(are_too_many(10, 100));
  EXPECT_TRUE(are_too_many(11, 100));
}

}  // namespace
}  // namespace cornerd::survey
