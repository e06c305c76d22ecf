// SPDX-License-Identifier: MIT
#include "drivers/odometry/freeze_watch.hpp"

#include <gtest/gtest.h>

namespace cornerd::drivers {
namespace {

/// A wheel of 1 mm a count, a track of 0.1 m: a circle about one wheel is 628 counts of the other.
core::DriveGeometry geometry() {
  core::DriveGeometry geometry;
  geometry.wheel_radius_m = 0.001 * 1000 / core::kTwoPi;
  geometry.counts_per_turn = 1000;
  geometry.track_m = 0.1;
  return geometry;
}

class FreezeWatchTest : public ::testing::Test {
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
      watch_.add(reading);
    }
  }
  bool none() const {
    return !watch_.left_is_frozen() && !watch_.right_is_frozen() && !watch_.gyro_is_frozen();
  }

  FreezeWatch watch_{geometry()};
  std::int64_t left_ = 0;
  std::int64_t right_ = 0;
  double rate_ = 0;
  bool has_gyro_ = true;
};

TEST_F(FreezeWatchTest, RobotThatStands_IsNotFrozen) {
  drive(1000, 0, 0, 0);
  EXPECT_TRUE(none());
}

TEST_F(FreezeWatchTest, StraightDrive_LetsAGyroBeStill) {
  drive(1000, 10, 10, 0);
  EXPECT_TRUE(none());
}

TEST_F(FreezeWatchTest, CircleAroundAWheel_IsADrive) {
  drive(62, 0, 10, 1e-3);
  EXPECT_TRUE(none());
}

TEST_F(FreezeWatchTest, WheelThatStaysWhileTheOtherRollsOn_IsFrozenUntilItMoves) {
  drive(200, 0, 10, 1e-3);
  EXPECT_TRUE(watch_.left_is_frozen());
  EXPECT_FALSE(watch_.right_is_frozen());
  drive(1, 1, 10, 1e-3);
  EXPECT_FALSE(watch_.left_is_frozen());
  drive(200, 10, 0, 1e-3);
  EXPECT_TRUE(watch_.right_is_frozen());
}

TEST_F(FreezeWatchTest, RateThatStaysWhileTheRobotTurns_IsFrozen) {
  drive(20, -10, 10, 0);
  EXPECT_TRUE(watch_.gyro_is_frozen());
  drive(1, -10, 10, 1e-3);
  EXPECT_FALSE(watch_.gyro_is_frozen());
}

TEST_F(FreezeWatchTest, GyroThatIsNotThere_IsNotFrozen) {
  has_gyro_ = false;
  drive(100, -10, 10, 0);
  EXPECT_TRUE(none());
}

}  // namespace
}  // namespace cornerd::drivers
