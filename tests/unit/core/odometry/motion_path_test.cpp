// SPDX-License-Identifier: MIT
#include "core/odometry/motion_path.hpp"

#include <gtest/gtest.h>

#include "core/odometry/odometry_increment.hpp"

namespace cornerd::core {
namespace {

constexpr TimeNs kMs = 1'000'000;

TEST(MotionPath, BetweenReadings_FollowsArc) {
  MotionPath path;
  path.add(0, 100 * kMs, arc(0.1, 0));
  path.add(100 * kMs, 200 * kMs, arc(0.1, 1.0));
  const Pose2 half = path.at(150 * kMs);
  const Pose2 expected = Pose2{0.1, 0, 0} * arc(0.05, 0.5);
  EXPECT_NEAR(half.x_m, expected.x_m, 1e-12);
  EXPECT_NEAR(half.y_m, expected.y_m, 1e-12);
  EXPECT_NEAR(half.theta_rad, 0.5, 1e-12);
  EXPECT_NEAR(path.at(0).x_m, 0, 1e-12);
  EXPECT_NEAR(path.at(50 * kMs).x_m, 0.05, 1e-12);
}

TEST(MotionPath, AfterLastReading_IsExtrapolated) {
  MotionPath path;
  path.add(0, 100 * kMs, arc(0.1, 0.2));
  EXPECT_TRUE(path.covers(0, 200 * kMs));
  const Pose2 later = path.at(200 * kMs);
  EXPECT_NEAR(later.theta_rad, 0.4, 1e-12);
  EXPECT_FALSE(path.covers(0, 500 * kMs));
  EXPECT_FALSE(path.covers(-1, 50 * kMs));
}

TEST(MotionPath, Gap_IsNotCovered) {
  MotionPath path;
  path.add(0, 100 * kMs, arc(0.1, 0));
  path.add(150 * kMs, 250 * kMs, arc(0.1, 0));
  EXPECT_FALSE(path.covers(100 * kMs, 200 * kMs));
  EXPECT_TRUE(path.covers(150 * kMs, 200 * kMs));
}

TEST(MotionPath, SpeedChange_IsLocated) {
  MotionPath path;
  const auto drive = [&](int i, double way_m) {
    path.add(i * kNsPerSecond / 10, (i + 1) * kNsPerSecond / 10, arc(way_m, 0));
  };
  for (int i = 0; i < 10; ++i) drive(i, 0.02);
  for (int i = 10; i < 20; ++i) drive(i, 0.05);
  // One change in eleven.
  EXPECT_NEAR(path.mean_square_change(kNsPerSecond / 2, 3 * kNsPerSecond / 2).x_m2,
              0.03 * 0.03 / 11, 1e-9);
  EXPECT_NEAR(path.mean_square_change(3 * kNsPerSecond / 2, 2 * kNsPerSecond).x_m2, 0, 1e-9);
}

TEST(MotionPath, LongDrive_KeepsLastTwoSeconds) {
  MotionPath path;
  for (int i = 0; i < 5000; ++i) path.add(i * 5 * kMs, (i + 1) * 5 * kMs, arc(0.001, 0));
  EXPECT_TRUE(path.covers(23'000 * kMs, 25'000 * kMs));
  EXPECT_FALSE(path.covers(20'000 * kMs, 25'000 * kMs));
  EXPECT_NEAR(path.at(25'000 * kMs).x_m - path.at(24'000 * kMs).x_m, 0.2, 1e-9);
}

TEST(MotionPath, Empty_CoversNothing) { EXPECT_FALSE(MotionPath().covers(0, 0)); }

}  // namespace
}  // namespace cornerd::core
