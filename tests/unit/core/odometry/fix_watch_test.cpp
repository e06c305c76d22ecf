// SPDX-License-Identifier: MIT
#include "core/odometry/fix_watch.hpp"

#include <gtest/gtest.h>

namespace cornerd::core {
namespace {

constexpr double kTurn_rad = 0.2;

/// A fix at the predicted pose.
void accept_fix(FixWatch& watch, double way_m, double rotation_rad) {
  const FixWatch::Way way{Vec2(way_m, 0), rotation_rad};
  watch.add_explained(way, way);
}

FixWatch doubting() {
  FixWatch watch;
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(watch.is_believed()) << k;
    watch.add_stranger(true);
    accept_fix(watch, 0.05, 0);
  }
  return watch;
}

TEST(FixWatch, RejectedFixesBetweenStraights_StayCounted) {
  FixWatch watch = doubting();
  EXPECT_FALSE(watch.is_believed());
  for (int k = 0; k < 100; ++k) accept_fix(watch, 0.05, k % 2 == 0 ? 0.01 : -0.01);
  EXPECT_FALSE(watch.is_believed());
  EXPECT_FALSE(watch.is_contradicted());
}

TEST(FixWatch, PredictedRotations_Validate) {
  FixWatch watch = doubting();
  for (int k = 0; k < 5; ++k) {
    EXPECT_FALSE(watch.is_believed()) << k;
    accept_fix(watch, 0.05, k % 2 == 0 ? kTurn_rad : -kTurn_rad);
  }
  EXPECT_TRUE(watch.is_believed());
}

TEST(FixWatch, OccasionalRejectedFixes_AreSlips) {
  FixWatch watch;
  for (int k = 0; k < 20; ++k) {
    watch.add_stranger(true);
    EXPECT_TRUE(watch.is_believed()) << k;
    for (int scans = 0; scans < 3; ++scans) accept_fix(watch, 0.05, kTurn_rad);
  }
}

TEST(FixWatch, RejectedFixesOfTranslation_CountConsecutively) {
  FixWatch watch;
  for (int k = 0; k < 20; ++k) {
    watch.add_stranger(false);
    watch.add_stranger(false);
    accept_fix(watch, 0.05, 0);
  }
  EXPECT_TRUE(watch.is_believed());
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(watch.is_believed()) << k;
    watch.add_stranger(false);
  }
  EXPECT_TRUE(watch.is_contradicted());
  EXPECT_FALSE(watch.is_believed());
  watch.interrupt();
  EXPECT_TRUE(watch.is_believed()) << "it was carried, and is looked for anew";
}

TEST(FixWatch, FirstMotion_NeedsConfirmationByLidar) {
  FixWatch watch;
  EXPECT_TRUE(watch.carries(0.01, 0.01)) << "it stands";
  EXPECT_FALSE(watch.carries(0.1, 0));
  accept_fix(watch, 0.05, 0);
  EXPECT_TRUE(watch.carries(0.1, 0.01));
  EXPECT_FALSE(watch.carries(0.1, kTurn_rad));
  accept_fix(watch, 0.05, kTurn_rad);
  EXPECT_TRUE(watch.carries(10, 10));
}

TEST(FixWatch, SlowRobot_IsValidatedOverManyFixes) {
  FixWatch watch;
  for (int k = 0; k < 8; ++k) accept_fix(watch, 0.003, 0.01);
  EXPECT_TRUE(watch.carries(10, 10));
}

TEST(FixWatch, SlowRobotWrongOdometry_IsNotValidated) {
  FixWatch watch;
  for (int k = 0; k < 100; ++k) {
    watch.add_explained({Vec2(0.003, 0), 0.01}, {Vec2(-0.003, 0), -0.01});
  }
  EXPECT_FALSE(watch.carries(0.1, 0));
  EXPECT_FALSE(watch.carries(0, kTurn_rad));
}

TEST(FixWatch, StationaryRobot_IsNotValidated) {
  FixWatch watch;
  for (int k = 0; k < 1000; ++k) accept_fix(watch, k % 2 == 0 ? 0.002 : -0.002, 0);
  EXPECT_FALSE(watch.carries(0.1, 0));
}

TEST(FixWatch, AfterRejectedFix_NoPredictionUntilAcceptedFix) {
  FixWatch watch;
  accept_fix(watch, 0.05, kTurn_rad);
  watch.add_stranger(true);
  EXPECT_FALSE(watch.carries(0, 0));
  accept_fix(watch, 0.05, 0);
  EXPECT_TRUE(watch.carries(1, 0));
  EXPECT_FALSE(watch.carries(1, kTurn_rad)) << "it was about turning";
  accept_fix(watch, 0.05, kTurn_rad);
  EXPECT_TRUE(watch.carries(1, kTurn_rad));
}

}  // namespace
}  // namespace cornerd::core
