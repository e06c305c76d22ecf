// SPDX-License-Identifier: MIT
#include "survey/survey.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

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
  config.scans = 230;
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

TEST(Survey, TwoRooms_AreMappedToMillimetres) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  const SurveyResult result = survey(simulated.drive, {});
  const core::WallMap found(result.plan);
  const auto score =
      bench::score_survey(*two_rooms(), simulated.T_map_base, found, simulated.T_map_base[0]);
  EXPECT_EQ(score.walls_found, score.walls_visible);
  EXPECT_GE(score.walls_visible, 9U);
  EXPECT_LT(score.invented_m, 0.05);
  EXPECT_EQ(score.corners_found, score.corners_visible);
  EXPECT_LT(score.corner_median_m(), 0.002);
  EXPECT_LT(score.corner_max_m(), 0.01);
  ASSERT_TRUE(result.learned.has_value());
  EXPECT_NEAR(result.learned->gyro_scale, 0.02, 0.004);
}

TEST(Survey, Frame_IsThatOfFirstScan) {
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

TEST(Survey, WithoutOdometry_OverlappingScans_GiveTheMap) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/false);
  const SurveyResult result = survey(simulated.drive, {});
  EXPECT_FALSE(result.has_odometry);
  EXPECT_TRUE(result.degenerate_scans.empty());
  const core::WallMap found(result.plan);
  const auto score =
      bench::score_survey(*two_rooms(), simulated.T_map_base, found, simulated.T_map_base[0]);
  EXPECT_EQ(score.walls_found, score.walls_visible);
  EXPECT_LT(score.corner_median_m(), 0.005);
}

TEST(Survey, Manhattan_MakesWallsSquare) {
  SurveyConfig config;
  config.manhattan = true;
  const SurveyResult result = survey(drive_through(/*has_odometry=*/true).drive, config);
  ASSERT_TRUE(result.squared.has_value());
  EXPECT_GE(result.squared->square, 8U);
  const Vec2 first = result.plan.walls[0].to - result.plan.walls[0].from;
  for (const core::Wall& wall : result.plan.walls) {
    if ((wall.to - wall.from).norm() < 0.3) continue;
    const double rotation_rad = core::angle_of(wall.to - wall.from) - core::angle_of(first);
    const double square_rad = std::round(rotation_rad / (core::kPi / 2)) * (core::kPi / 2);
    EXPECT_NEAR(rotation_rad, square_rad, 1e-4);
  }
}

/// The same drive with changed readings.
template <typename Change>
RecordedDrive with_changed_readings(const RecordedDrive& recorded, const Change& change) {
  RecordedDrive drive = recorded.without_odometry();
  std::vector<core::OdometryReading> readings;
  for (const RecordedDrive::Reading& reading : recorded.readings()) {
    readings.push_back(reading.reading);
    change(readings.back());
  }
  drive.set_odometry(readings);
  return drive;
}

void expect_correct_without_odometry(const bench::SimulatedDrive& simulated,
                                     const SurveyResult& result) {
  ASSERT_TRUE(result.rejected_odometry.has_value());
  EXPECT_FALSE(result.has_odometry);
  const auto score = bench::score_survey(*two_rooms(), simulated.T_map_base,
                                         core::WallMap(result.plan), simulated.T_map_base[0]);
  EXPECT_EQ(score.walls_found, score.walls_visible);
  EXPECT_LT(score.invented_m, 0.05);
  EXPECT_LT(score.corner_max_m(), 0.01);
}

TEST(Survey, StuckWheelCounter_RejectsOdometry) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  const SurveyResult result =
      survey(with_changed_readings(simulated.drive,
                                   [](core::OdometryReading& reading) { reading.left = 7; }),
             {});
  expect_correct_without_odometry(simulated, result);
  EXPECT_GT(result.rejected_odometry->contradicted_scans, result.t_ns.size() / 10);
  EXPECT_NEAR(result.rejected_odometry->left.counted_m, 0, 1e-9);
  EXPECT_NEAR(result.rejected_odometry->right.counted_m, result.rejected_odometry->right.lidar_m,
              0.05 * result.rejected_odometry->right.lidar_m);
}

TEST(Survey, DoubledCounts_RejectOdometry) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  const SurveyResult result =
      survey(with_changed_readings(simulated.drive,
                                   [](core::OdometryReading& reading) {
                                     reading.left = 2 * reading.left.value();
                                     reading.right = 2 * reading.right.value();
                                     reading.gyro_rad_s.reset();
                                   }),
             {});
  expect_correct_without_odometry(simulated, result);
  EXPECT_NEAR(result.rejected_odometry->left.counted_m / result.rejected_odometry->left.lidar_m, 2,
              0.1);
}

TEST(Survey, OdometryMissingInFirstHalf_IsRejected) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  const auto readings = simulated.drive.readings();
  std::vector<core::OdometryReading> rest;
  for (std::size_t i = readings.size() / 2; i < readings.size(); ++i) {
    rest.push_back(readings[i].reading);
  }
  RecordedDrive drive = simulated.drive.without_odometry();
  drive.set_odometry(rest);
  const SurveyResult result = survey(drive, {});
  expect_correct_without_odometry(simulated, result);
  EXPECT_NEAR(static_cast<double>(result.rejected_odometry->scans_without_odometry),
              static_cast<double>(drive.size()) / 2, 10);
}

TEST(Survey, ConsistentOdometry_IsNotRejected) {
  EXPECT_FALSE(
      survey(drive_through(/*has_odometry=*/true).drive, {}).rejected_odometry.has_value());
}

TEST(Survey, GyroWithoutWheels_SurveysByLidarAlone) {
  const bench::SimulatedDrive simulated = drive_through(/*has_odometry=*/true);
  const SurveyResult result = survey(with_changed_readings(simulated.drive,
                                                           [](core::OdometryReading& reading) {
                                                             reading.left.reset();
                                                             reading.right.reset();
                                                           }),
                                     {});
  EXPECT_FALSE(result.has_odometry);
  EXPECT_FALSE(result.has_gyro);
  EXPECT_FALSE(result.learned.has_value());
}

TEST(Survey, Progress_NamesPhasesAndNeverDecreases) {
  double last = 0;
  std::set<std::string> phases;
  survey(drive_through(/*has_odometry=*/true).drive, {}, [&](std::string_view phase, double share) {
    EXPECT_GE(share, last);
    last = share;
    phases.emplace(phase);
  });
  EXPECT_GT(last, 0.99);
  EXPECT_EQ(phases.count("closing loops"), 1U);
  EXPECT_EQ(phases.size(), 5U);
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

TEST(Survey, NoScans_Throws) { EXPECT_THROW(survey(RecordedDrive(), {}), std::invalid_argument); }

TEST(Survey, NoReturns_Throws) {
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
