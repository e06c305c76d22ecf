// SPDX-License-Identifier: MIT
#include "survey/adjustment.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

const std::vector<std::pair<Vec2, Vec2>> kRoom = {
    {{-1, -1}, {3, -1}}, {{3, -1}, {3, 2}}, {{3, 2}, {-1, 2}}, {{-1, 2}, {-1, -1}}};
const std::vector<core::Pose2> kTrajectory = {
    {0, 0, 0}, {0.5, 0, 0.1}, {1, 0.2, 0.4}, {1.2, 0.6, 1.2}};

TEST(Adjustment, Adjust_DisturbedPosesAndWalls_AreRestored) {
  MappedDrive drive = mapped_drive(kRoom, kTrajectory);
  for (std::size_t i = 1; i < kTrajectory.size(); ++i) {
    drive.T_map_lidar[i].x_m += 0.03;
    drive.T_map_lidar[i].theta_rad -= 0.02;
  }
  drive.faces[1].set_line(drive.faces[1].normal_rad() + 0.03, 0.05);
  const AdjustmentResult result = adjust(drive);
  EXPECT_LT(result.sigma, 1e-3);
  EXPECT_EQ(result.outliers, 0U);
  for (std::size_t i = 0; i < kTrajectory.size(); ++i) {
    EXPECT_NEAR(drive.T_map_lidar[i].x_m, kTrajectory[i].x_m, 1e-4);
    EXPECT_NEAR(drive.T_map_lidar[i].y_m, kTrajectory[i].y_m, 1e-4);
    EXPECT_NEAR(drive.T_map_lidar[i].theta_rad, kTrajectory[i].theta_rad, 1e-4);
  }
  EXPECT_NEAR(drive.faces[1].height_of({3, 0}), 0, 1e-4);
}

TEST(Adjustment, Adjust_FirstPose_IsFixed) {
  MappedDrive drive = mapped_drive(kRoom, kTrajectory);
  drive.T_map_lidar[0] = {0.2, 0.1, 0.05};
  adjust(drive);
  EXPECT_DOUBLE_EQ(drive.T_map_lidar[0].x_m, 0.2);
  EXPECT_DOUBLE_EQ(drive.T_map_lidar[0].theta_rad, 0.05);
}

TEST(Adjustment, Adjust_OneOutlier_IsDownweighted) {
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i < 20; ++i) trajectory.push_back({0.05 * i, 0, 0});
  MappedDrive drive = mapped_drive(kRoom, trajectory);
  for (MatchedObservation& observation : drive.observations) {
    if (observation.scan == 10 && observation.face == 1) observation.seen.centroid.x() += 0.1;
  }
  const AdjustmentResult result = adjust(drive);
  EXPECT_EQ(result.outliers, 1U);
  EXPECT_NEAR(drive.T_map_lidar[10].x_m, trajectory[10].x_m, 5e-4);
  EXPECT_NEAR(drive.faces[1].height_of({3, 0}), 0, 1e-4);
}

TEST(Adjustment, Adjust_FaceConstraint_MakesFacesParallel) {
  std::vector<std::pair<Vec2, Vec2>> walls = kRoom;
  walls[2] = {{3, 2}, {-1, 2.004}};  // a milliradian askew
  MappedDrive drive = mapped_drive(walls, kTrajectory);
  FaceConstraint constraint;
  constraint.one = 0;
  constraint.other = 2;
  constraint.rotation_rad = core::kPi;
  constraint.sigma_rad = 1e-6;
  adjust(drive, std::span(&constraint, 1));
  EXPECT_NEAR(
      core::angle_between(drive.faces[0].normal_rad() + core::kPi, drive.faces[2].normal_rad()), 0,
      1e-6);
}

TEST(Adjustment, Adjust_MoreObservations_GiveSmallerVariance) {
  MappedDrive few = mapped_drive(kRoom, std::vector<core::Pose2>(3, core::Pose2{0.5, 0.5, 0}));
  MappedDrive many = mapped_drive(kRoom, std::vector<core::Pose2>(12, core::Pose2{0.5, 0.5, 0}));
  adjust(few);
  adjust(many);
  EXPECT_NEAR(few.faces[0].variance_at(0) / many.faces[0].variance_at(0), 4, 0.01);
}

/// A straight trajectory of 20 odometry edges, each with a sigma of 1 cm, and no walls.
MappedDrive drive_without_walls() {
  MappedDrive drive;
  for (int i = 0; i <= 20; ++i) drive.T_map_lidar.push_back({0.1 * i, 0, 0});
  drive.odometry_edges.resize(1);
  for (int i = 1; i <= 20; ++i) {
    OdometryEdge link;
    link.T_before_now = {0.1, 0, 0};
    link.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-10).asDiagonal();
    drive.odometry_edges.push_back(link);
  }
  return drive;
}

TEST(Adjustment, RelativePoseCovariance_OdometryAlone_GrowsByEdge) {
  const MappedDrive drive = drive_without_walls();
  EXPECT_NEAR(relative_pose_covariance(drive, 0, 16)(0, 0), 16e-4, 1e-6);
  EXPECT_NEAR(relative_pose_covariance(drive, 7, 11)(1, 1), 4e-4, 1e-6);
}

TEST(Adjustment, Adjust_LoopConstraint_IsDistributedOverTheLoop) {
  MappedDrive drive = drive_without_walls();
  drive.loop_constraints.push_back({0, 20, {2.1, 0, 0}, 0.001, 0.001});
  adjust(drive);
  EXPECT_NEAR(drive.T_map_lidar[20].x_m, 2.1, 1e-3);
  EXPECT_NEAR(drive.T_map_lidar[10].x_m, 1.05, 1e-3);
}

TEST(Adjustment, Adjust_WrongLoopConstraint_IsDownweighted) {
  MappedDrive drive = mapped_drive(kRoom, kTrajectory);
  drive.loop_constraints.push_back({0, 3, {1.5, 0.6, 1.2}, 0.03, 0.01});
  adjust(drive);
  EXPECT_NEAR(drive.T_map_lidar[3].x_m, kTrajectory[3].x_m, 2e-3);
}

TEST(Adjustment, Adjust_SingleScan_ChangesNothing) {
  MappedDrive drive = mapped_drive(kRoom, std::span(kTrajectory).first(1));
  EXPECT_EQ(adjust(drive).steps, 0);
}

}  // namespace
}  // namespace cornerd::survey
