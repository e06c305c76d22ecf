// SPDX-License-Identifier: MIT
#include "survey/rejected_odometry.hpp"

#include <gtest/gtest.h>

namespace cornerd::survey {
namespace {

/// 2 m straight ahead in 20 scans of 0.1 s; a count is 0.1 m, the right wheel's counter wraps
/// at 10.
TEST(MeasureWheelDistances, StuckCounter_GivesZero) {
  core::OdometryConfig config;
  config.geometry.wheel_radius_m = 1 / core::kTwoPi;
  config.geometry.counts_per_turn = 10;
  config.geometry.counter_max = 9;
  RecordedDrive drive;
  std::vector<core::Pose2> trajectory;
  for (int i = 0; i <= 20; ++i) {
    core::OdometryReading reading;
    reading.t_ns = i * 100'000'000;
    reading.left = 3;
    reading.right = i % 10;
    drive.add(reading.arrived(reading.t_ns));
    trajectory.push_back({0.1 * i, 0, 0});
  }
  RejectedOdometry rejected;
  measure_wheel_distances(drive, trajectory, config, rejected);
  EXPECT_NEAR(rejected.left.counted_m, 0, 1e-12);
  EXPECT_NEAR(rejected.right.counted_m, 2, 1e-9);
  EXPECT_NEAR(rejected.left.lidar_m, 2, 1e-9);
  EXPECT_NEAR(rejected.right.lidar_m, 2, 1e-9);
}

TEST(MeasureWheelDistances, RotationInPlace_GivesHalfTrackTimesAngle) {
  core::OdometryConfig config;
  config.geometry.track_m = 0.2;
  const std::vector<core::Pose2> trajectory = {{}, {0, 0, 1}};
  RejectedOdometry rejected;
  measure_wheel_distances({}, trajectory, config, rejected);
  EXPECT_NEAR(rejected.left.lidar_m, 0.1, 1e-12);
  EXPECT_NEAR(rejected.right.lidar_m, 0.1, 1e-12);
}

TEST(ExceedsRejectionShare, TenthOfScans_IsFalse) {
  EXPECT_FALSE(exceeds_rejection_share(10, 100));
  EXPECT_TRUE(exceeds_rejection_share(11, 100));
}

}  // namespace
}  // namespace cornerd::survey
