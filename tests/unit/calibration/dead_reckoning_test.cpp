// SPDX-License-Identifier: MIT
#include "calibration/dead_reckoning.hpp"

#include <gtest/gtest.h>

namespace cornerd::calibration {
namespace {

constexpr core::DriveGeometry kRobot{0.05, 0.2, 1000, 0};

core::OdometryIncrement step_of(double left_m, double right_m, double gyro_rad) {
  core::OdometryIncrement step;
  step.to_ns = core::kNsPerSecond / 10;
  step.left_m = left_m;
  step.right_m = right_m;
  step.gyro_rad = gyro_rad;
  step.has_gyro = true;
  return step;
}

TEST(HeadingChange, EachMode_MatchesItsEquation) {
  const core::OdometryIncrement step = step_of(0.01, 0.03, 0.2);  // wheels: 0.1 rad
  const auto change = [&](HeadingSource source, double c_enco, double c_gyro) {
    return heading_change(step, kRobot, {source, {c_enco, c_gyro, 0}});
  };
  EXPECT_DOUBLE_EQ(change(HeadingSource::kEncoder, 1, 1), 0.1);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kEncoder, 1.5, 1), 0.15);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kGyro, 1, 1), 0.2);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kGyro, 1, 0.9), 0.18);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kMean, 1, 1), 0.15);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kMean, 2, 2), 0.15);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kMean, 0, 0), 0.15);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kWeighted, 1.5, 0.9), (0.15 + 0.18) / 2);
  EXPECT_DOUBLE_EQ(change(HeadingSource::kWeighted, 0, 2), 0.2);
}

TEST(HeadingChange, NoGyro_UsesEncoders) {
  core::OdometryIncrement step = step_of(0.01, 0.03, 0.2);
  step.has_gyro = false;
  EXPECT_DOUBLE_EQ(heading_change(step, kRobot, {HeadingSource::kMean, {1, 1, 0}}), 0.1);
}

TEST(DeadReckoning, CircleInSmallIncrements_EndsAtStart) {
  DeadReckoning odometry(kRobot, {});
  for (int i = 0; i < 1000; ++i) {
    odometry.add(step_of((0.5 - 0.1) * core::kTwoPi / 1000, (0.5 + 0.1) * core::kTwoPi / 1000, 0));
  }
  EXPECT_NEAR(odometry.pose().x_m, 0, 1e-9);
  EXPECT_NEAR(odometry.pose().y_m, 0, 1e-9);
  EXPECT_NEAR(odometry.pose().theta_rad, 0, 1e-9);
}

TEST(DeadReckoning, QuarterCircle_UsesMidpointHeading) {
  DeadReckoning odometry(kRobot, {}, {1, 2, core::kPi / 2});
  const core::Pose2& pose = odometry.add(step_of(0.1, 0.1 + 0.2 * core::kPi / 2, 0));
  const double way_m = 0.1 + 0.2 * core::kPi / 4;
  EXPECT_NEAR(pose.x_m, 1 - way_m * std::sin(core::kPi / 4), 1e-12);
  EXPECT_NEAR(pose.y_m, 2 + way_m * std::cos(core::kPi / 4), 1e-12);
  EXPECT_NEAR(pose.theta_rad, core::kPi, 1e-12);
}

TEST(DeadReckoning, DeadBand_DropsSlowDrive) {
  DeadReckoning with(kRobot, {HeadingSource::kEncoder, {1, 1, 0.01}});
  DeadReckoning without(kRobot, {});
  // Each step turns the wheels by 0.008 and 0.006 rad: under the paper's 0.01.
  for (int i = 0; i < 100; ++i) {
    with.add(step_of(0.0004, 0.0003, 0));
    without.add(step_of(0.0004, 0.0003, 0));
  }
  EXPECT_EQ(with.pose().x_m, 0);
  EXPECT_GT(without.pose().x_m, 0.03);
  with.add(step_of(0.01, 0.02, 0));
  EXPECT_GT(with.pose().x_m, 0.01);
}

}  // namespace
}  // namespace cornerd::calibration
