// SPDX-License-Identifier: MIT
#include "drivers/odometry/stuck_detector.hpp"

#include <gtest/gtest.h>

namespace cornerd::drivers {
namespace {

/// 1 mm per count, track 0.1 m: a circle about one wheel is 628 counts of the other.
core::DriveGeometry geometry() {
  core::DriveGeometry geometry;
  geometry.wheel_radius_m = 0.001 * 1000 / core::kTwoPi;
  geometry.counts_per_turn = 1000;
  geometry.track_m = 0.1;
  return geometry;
}

class StuckDetectorTest : public ::testing::Test {
 protected:
  void drive(int times, int left, int right, double rate_step) {
    for (int i = 0; i < times; ++i) {
      left_ += left;
      right_ += right;
      rate_ += rate_step;
      core::OdometryReading reading;
      reading.left = left_;
      reading.right = right_;
      if (has_gyro_) reading.gyro_rad_s = rate_;
      detector_.add(reading);
    }
  }
  bool none() const {
    return !detector_.left_is_stuck() && !detector_.right_is_stuck() && !detector_.gyro_is_stuck();
  }

  StuckDetector detector_{geometry()};
  std::int64_t left_ = 0;
  std::int64_t right_ = 0;
  double rate_ = 0;
  bool has_gyro_ = true;
};

TEST_F(StuckDetectorTest, RobotAtRest_NothingIsStuck) {
  drive(1000, 0, 0, 0);
  EXPECT_TRUE(none());
}

TEST_F(StuckDetectorTest, StraightDrive_ConstantRateIsNotStuck) {
  drive(1000, 10, 10, 0);
  EXPECT_TRUE(none());
}

TEST_F(StuckDetectorTest, OneCircleAroundAWheel_NothingIsStuck) {
  drive(62, 0, 10, 1e-3);
  EXPECT_TRUE(none());
}

TEST_F(StuckDetectorTest, ConstantCountWhileOtherWheelMoves_IsStuckUntilItChanges) {
  drive(200, 0, 10, 1e-3);
  EXPECT_TRUE(detector_.left_is_stuck());
  EXPECT_FALSE(detector_.right_is_stuck());
  drive(1, 1, 10, 1e-3);
  EXPECT_FALSE(detector_.left_is_stuck());
  drive(200, 10, 0, 1e-3);
  EXPECT_TRUE(detector_.right_is_stuck());
}

TEST_F(StuckDetectorTest, ConstantRateWhileRobotRotates_IsStuckUntilItChanges) {
  drive(20, -10, 10, 0);
  EXPECT_TRUE(detector_.gyro_is_stuck());
  drive(1, -10, 10, 1e-3);
  EXPECT_FALSE(detector_.gyro_is_stuck());
}

TEST_F(StuckDetectorTest, NoGyro_IsNotStuck) {
  has_gyro_ = false;
  drive(100, -10, 10, 0);
  EXPECT_TRUE(none());
}

}  // namespace
}  // namespace cornerd::drivers
