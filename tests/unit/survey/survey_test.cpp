// SPDX-License-Identifier: MIT
#include "survey/survey.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "bench/simulated_drive.hpp"
#include "bench/survey_scoring.hpp"
#include "replay/simulator/motion.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// Two rooms of 2.4 m with a door between them.
std::shared_ptr<const core::WallMap> two_rooms() {
  core::FloorPlan plan;
  plan.walls = {{{0, 0}, {5, 0}, 0.1},       {{5, 0}, {5, 2.4}, 0.1},
                {{5, 2.4}, {0, 2.4}, 0.1},   {{0, 2.4}, {0, 0}, 0.1},
                {{2.5, 0}, {2.5, 0.8}, 0.1}, {{2.5, 1.7}, {2.5, 2.4}, 0.1}};
  return std::make_shared<const core::WallMap>(plan);
}

bench::SimulatedDrive drive_through(bool has_odometry) {
  bench::SimulatedDriveConfig config;
  config.turns = 230;
  config.has_odometry = has_odometry;
  config.robot.left_scale = 0.015;
  config.robot.right_scale = 0.025;
  config.robot.gyro_scale = 0.02;
  config.robot.gyro_bias_rad_s = 0.01;
  replay::DriveConfig drive;
  drive.speed_m_s = 0.3;
  drive.acceleration_m_s2 = 1;
  drive.yaw_acceleration_rad_s2 = 4;
  drive.loop = true;
  const std::vector<Vec2> path = {{0.7, 0.7}, {0.9, 1.2}, {4, 1.2}, {4.2, 0.6}, {3.4, 1.9}};
  return bench::simulate_drive(two_rooms(), replay::drive_path(path, drive), config);
}

TEST(Survey, TwoRooms_AreFoundToMillimetres) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  const SurveyResult result = survey(simulated.drive, {});
  const core::WallMap found(result.plan);
  const auto score =
      bench::score_survey(*two_rooms(), simulated.T_map_base, found, simulated.T_map_base[0]);
  EXPECT_EQ(score.walls_found, score.walls_seen);
  EXPECT_GE(score.walls_seen, 9U);
  EXPECT_LT(score.invented_m, 0.05);
  EXPECT_EQ(score.corners_found, score.corners_seen);
  EXPECT_LT(score.corner_median_m(), 0.002);
  EXPECT_LT(score.corner_max_m(), 0.01);
  ASSERT_TRUE(result.learned.has_value());
  EXPECT_NEAR(result.learned->gyro_scale, 0.02, 0.004);
}

TEST(Survey, Frame_IsThatOfTheFirstTurn) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  SurveyConfig config;
  const SurveyResult result = survey(simulated.drive, config);
  EXPECT_DOUBLE_EQ(result.T_map_base.front().x_m, 0);
  EXPECT_DOUBLE_EQ(result.T_map_base.front().theta_rad, 0);
  for (std::size_t i = 0; i < result.T_map_base.size(); i += 20) {
    const core::Pose2 off =
        (simulated.T_map_base[0].inverse() * simulated.T_map_base[i]).inverse() *
        result.T_map_base[i];
    EXPECT_LT(off.translation().norm(), 0.01);
  }
}

TEST(Survey, InnerWall_HasItsThickness) {
  const SurveyResult result = survey(drive_through(/*has_odometry=*/true).drive, {});
  int solids = 0;
  for (const core::Wall& wall : result.plan.walls) {
    if (wall.thickness_m == 0) continue;
    EXPECT_NEAR(wall.thickness_m, 0.1, 0.003);
    ++solids;
  }
  EXPECT_EQ(solids, 2);
}

TEST(Survey, WithoutOdometry_OverlappingTurnsAreEnough) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/false);
  const SurveyResult result = survey(simulated.drive, {});
  EXPECT_FALSE(result.has_odometry);
  EXPECT_TRUE(result.blind_turns.empty());
  const core::WallMap found(result.plan);
  const auto score =
      bench::score_survey(*two_rooms(), simulated.T_map_base, found, simulated.T_map_base[0]);
  EXPECT_EQ(score.walls_found, score.walls_seen);
  EXPECT_LT(score.corner_median_m(), 0.005);
}

TEST(Survey, Manhattan_MakesWallsSquare) {
  SurveyConfig config;
  config.manhattan = true;
  const SurveyResult result = survey(drive_through(/*has_odometry=*/true).drive, config);
  const Vec2 first = result.plan.walls[0].to - result.plan.walls[0].from;
  for (const core::Wall& wall : result.plan.walls) {
    if ((wall.to - wall.from).norm() < 0.3) continue;
    const double turn_rad = core::angle_of(wall.to - wall.from) - core::angle_of(first);
    const double square_rad = std::round(turn_rad / (core::kPi / 2)) * (core::kPi / 2);
    EXPECT_NEAR(turn_rad, square_rad, 1e-4);
  }
}

TEST(Survey, SameDriveTwice_GivesTheSameMap) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  const SurveyResult one = survey(simulated.drive, {});
  const SurveyResult other = survey(simulated.drive, {});
  ASSERT_EQ(one.plan.walls.size(), other.plan.walls.size());
  for (std::size_t i = 0; i < one.plan.walls.size(); ++i) {
    EXPECT_EQ(one.plan.walls[i].from, other.plan.walls[i].from);
  }
}

TEST(Survey, NoTurns_SaysSo) { EXPECT_THROW(survey(RecordedDrive(), {}), std::invalid_argument); }

TEST(Survey, NothingInReach_SaysSo) {
  RecordedDrive drive;
  core::Scan scan;
  for (int i = 0; i < 300; ++i) {
    core::Sample sample;
    sample.t_ns = i * 400'000;
    sample.bearing_rad = static_cast<float>(core::kPi - i * core::kTwoPi / 300);
    scan.add(sample);
  }
  for (int i = 0; i < 10; ++i) drive.add(scan);
  EXPECT_THROW(survey(drive, {}), std::invalid_argument);
}

}  // namespace
}  // namespace cornerd::survey
