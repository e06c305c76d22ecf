// SPDX-License-Identifier: MIT
#include "replay/simulator/motion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace cornerd::replay {
namespace {

core::Pose2 at(const Motion& motion, double t_s) { return motion(core::from_seconds(t_s), 0); }

TEST(DrivePath, Corner_IsARotationOnTheSpot) {
  DriveConfig config;
  config.speed_m_s = 0.5;
  config.yaw_rate_rad_s = core::kPi / 2;
  const Motion motion = drive_path({{0, 0}, {1, 0}, {1, 1}}, config);
  EXPECT_NEAR(at(motion, 1).x_m, 0.5, 1e-9);
  EXPECT_NEAR(at(motion, 2.5).x_m, 1, 1e-9);
  EXPECT_NEAR(at(motion, 2.5).y_m, 0, 1e-9);
  EXPECT_NEAR(at(motion, 2.5).theta_rad, core::kPi / 4, 1e-9);
  EXPECT_NEAR(at(motion, 4).y_m, 0.5, 1e-9);
  EXPECT_NEAR(at(motion, 4).theta_rad, core::kPi / 2, 1e-9);
  EXPECT_NEAR(at(motion, 100).y_m, 1, 1e-9);
}

TEST(DrivePath, Loop_IsPeriodic) {
  DriveConfig config;
  config.speed_m_s = 1;
  config.yaw_rate_rad_s = core::kPi;
  config.loop = true;
  // Four sides of a metre, four quarter turns of half a second: six seconds around.
  const Motion motion = drive_path({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, config);
  for (const double t_s : {0.3, 1.2, 2.9, 5.8}) {
    EXPECT_NEAR(at(motion, t_s).x_m, at(motion, t_s + 60).x_m, 1e-6);
    EXPECT_NEAR(at(motion, t_s).y_m, at(motion, t_s + 60).y_m, 1e-6);
    EXPECT_NEAR(core::angle_between(at(motion, t_s).theta_rad, at(motion, t_s + 60).theta_rad), 0,
                1e-6);
  }
  EXPECT_NEAR(at(motion, 6).x_m, 0, 1e-9);
  EXPECT_NEAR(at(motion, 5.75).theta_rad, -core::kPi / 4, 1e-9);
}

TEST(DrivePath, OnePointOrNoSpeed_IsRefused) {
  EXPECT_THROW(drive_path({{1, 1}, {1, 1}}, {}), std::invalid_argument);
  DriveConfig config;
  config.speed_m_s = 0;
  EXPECT_THROW(drive_path({{0, 0}, {1, 1}}, config), std::invalid_argument);
}

TEST(VisitPoses, Pose_ChangesWithTheScan) {
  const Motion motion = visit_poses({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 2);
  EXPECT_EQ(motion(0, -1).x_m, 1);
  EXPECT_EQ(motion(0, 1).x_m, 1);
  EXPECT_EQ(motion(0, 2).x_m, 2);
  EXPECT_EQ(motion(0, 5).x_m, 3);
  EXPECT_EQ(motion(0, 99).x_m, 3);
  EXPECT_THROW(visit_poses({}, 2), std::invalid_argument);
}

TEST(DrivePath, WithAcceleration_SpeedIsTrapezoidal) {
  DriveConfig config;
  config.speed_m_s = 1;
  config.acceleration_m_s2 = 0.5;
  const Motion motion = drive_path({{0, 0}, {4, 0}}, config);
  // Two seconds up to speed over 1 m, two at speed, two down again.
  EXPECT_DOUBLE_EQ(drive_duration_s({{0, 0}, {4, 0}}, config), 6);
  EXPECT_NEAR(at(motion, 1).x_m, 0.25, 1e-9);
  EXPECT_NEAR(at(motion, 2).x_m, 1, 1e-9);
  EXPECT_NEAR(at(motion, 3).x_m, 2, 1e-9);
  EXPECT_NEAR(at(motion, 5).x_m, 3.75, 1e-9);
  EXPECT_NEAR(at(motion, 6).x_m, 4, 1e-9);
  EXPECT_NEAR(at(motion, 9).x_m, 4, 1e-9);
}

TEST(DrivePath, ShortPath_SpeedIsTriangular) {
  DriveConfig config;
  config.speed_m_s = 10;
  config.acceleration_m_s2 = 1;
  EXPECT_NEAR(drive_duration_s({{0, 0}, {1, 0}}, config), 2, 1e-9);
  EXPECT_NEAR(at(drive_path({{0, 0}, {1, 0}}, config), 1).x_m, 0.5, 1e-9);
}

}  // namespace
}  // namespace cornerd::replay
