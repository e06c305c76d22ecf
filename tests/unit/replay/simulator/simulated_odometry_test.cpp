// SPDX-License-Identifier: MIT
#include "replay/simulator/simulated_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "calibration/dead_reckoning.hpp"
#include "core/odometry/reading_gate.hpp"

namespace cornerd::replay {
namespace {

RobotModel exact_robot() {
  RobotModel model;
  model.wheel_m_per_sqrt_m = 0;
  model.gyro_rad_s_per_sqrt_hz = 0;
  model.gyro_step_rad_s = 0;
  return model;
}

Motion square_drive() {
  DriveConfig drive;
  drive.speed_m_s = 0.5;
  drive.yaw_rate_rad_s = 1;
  drive.acceleration_m_s2 = 1;
  drive.yaw_acceleration_rad_s2 = 4;
  drive.loop = true;
  return drive_path({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, drive);
}

/// Final pose of dead reckoning with one heading source.
core::Pose2 reckoned(const RobotModel& model, calibration::HeadingSource source,
                     double duration_s) {
  SimulatedOdometry odometry(square_drive(), model, 7);
  core::OdometryConfig config;
  config.geometry = model.geometry;
  core::ReadingGate gate(config);
  calibration::DeadReckoning reckoning(config.geometry, {source, {}});
  while (odometry.next_ns() <= core::from_seconds(duration_s)) {
    if (const auto step = gate.add(odometry.next())) reckoning.add(*step);
  }
  return reckoning.pose();
}

TEST(SimulatedOdometry, ExactRobot_DeadReckoningEndsAtTheTruth) {
  for (const auto source :
       {calibration::HeadingSource::kEncoder, calibration::HeadingSource::kGyro}) {
    const core::Pose2 truth = square_drive()(core::from_seconds(30), 0);
    const core::Pose2 pose = reckoned(exact_robot(), source, 30);
    EXPECT_NEAR(pose.x_m, truth.x_m, 0.02);
    EXPECT_NEAR(pose.y_m, truth.y_m, 0.02);
    EXPECT_NEAR(core::angle_between(pose.theta_rad, truth.theta_rad), 0, 0.02);
  }
}

TEST(SimulatedOdometry, WrappingCounts_ChangeNothing) {
  RobotModel wide = exact_robot();
  RobotModel narrow = exact_robot();
  narrow.geometry.counter_max = 999;
  const core::Pose2 a = reckoned(wide, calibration::HeadingSource::kEncoder, 20);
  const core::Pose2 b = reckoned(narrow, calibration::HeadingSource::kEncoder, 20);
  EXPECT_NEAR(a.x_m, b.x_m, 1e-9);
  EXPECT_NEAR(a.theta_rad, b.theta_rad, 1e-9);
}

TEST(SimulatedOdometry, LargerWheel_GivesFewerCounts) {
  RobotModel model = exact_robot();
  DriveConfig drive;
  drive.speed_m_s = 1;
  model.left_scale = 0.02;
  model.right_scale = -0.02;
  SimulatedOdometry odometry(drive_path({{0, 0}, {10, 0}}, drive), model, 1);
  core::OdometryReading last;
  while (odometry.next_ns() <= core::from_seconds(5)) last = odometry.next();
  const double per_count_m = model.geometry.metres_per_count();
  EXPECT_NEAR(static_cast<double>(*last.left) * per_count_m, 5 / 1.02, 1e-3);
  EXPECT_NEAR(static_cast<double>(*last.right) * per_count_m, 5 / 0.98, 1e-3);
}

TEST(SimulatedOdometry, GyroErrors_AreScaleAndBias) {
  RobotModel model = exact_robot();
  model.gyro_scale = 0.02;
  model.gyro_bias_rad_s = 0.01;
  DriveConfig drive;
  drive.yaw_rate_rad_s = 1;
  drive.speed_m_s = 1;
  SimulatedOdometry odometry(drive_path({{0, 0}, {1, 0}, {0, 0}}, drive), model, 1);
  double straight = 0;
  double turning = 0;
  while (odometry.next_ns() <= core::from_seconds(3)) {
    const core::OdometryReading reading = odometry.next();
    if (reading.t_ns == core::from_seconds(0.5)) straight = *reading.gyro_rad_s;
    if (reading.t_ns == core::from_seconds(2)) turning = *reading.gyro_rad_s;
  }
  EXPECT_NEAR(straight, 0.01, 1e-6);
  EXPECT_NEAR(std::abs(turning), 1.02 + (turning > 0 ? 0.01 : -0.01), 1e-6);
}

TEST(SimulatedOdometry, Slips_AddCountsWithoutTravel) {
  RobotModel model = exact_robot();
  model.slips_per_m = 0.5;
  const core::Pose2 truth = square_drive()(core::from_seconds(60), 0);
  const core::Pose2 pose = reckoned(model, calibration::HeadingSource::kEncoder, 60);
  EXPECT_GT((pose.translation() - truth.translation()).norm(), 0.1);
}

TEST(SimulatedOdometry, RateZero_IsRefused) {
  RobotModel model;
  model.rate_hz = 0;
  EXPECT_THROW(SimulatedOdometry(square_drive(), model, 1), std::invalid_argument);
}

}  // namespace
}  // namespace cornerd::replay
