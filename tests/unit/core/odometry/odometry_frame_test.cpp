// SPDX-License-Identifier: MIT
#include "core/odometry/odometry_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/odometry/odometer.hpp"

namespace cornerd::core {
namespace {

constexpr DriveGeometry kWheels{0.05, 0.2, 1000, 0};
const double kCountLength_m = kWheels.metres_per_count();

OdometryConfig with_wheels() {
  OdometryConfig config;
  config.enabled = true;
  config.geometry = kWheels;
  return config;
}

/// Readings at 50 Hz of a robot that drives straight with these counts a reading.
class FrameDrive {
 public:
  explicit FrameDrive(const OdometryConfig& config = with_wheels()) : odometer(config) {}

  OdometryPose go(int readings, std::int64_t counts) {
    for (int i = 0; i < readings; ++i) {
      t_ns_ += kNsPerSecond / 50;
      counts_ += counts;
      odometer.add({t_ns_, counts_, counts_, std::nullopt, t_ns_});
      const double x_m = pose_.T_odom_base.x_m;
      if (odometer.last_motion()) pose_.add(*odometer.last_motion());
      largest_step_m = std::max(largest_step_m, pose_.T_odom_base.x_m - x_m);
    }
    return pose_;
  }
  void carry(std::int64_t counts) { counts_ += counts; }
  void wait(TimeNs duration_ns) { t_ns_ += duration_ns; }

  Odometer odometer;
  double largest_step_m = 0;

 private:
  TimeNs t_ns_ = 0;
  std::int64_t counts_ = 0;
  OdometryPose pose_;
};

TEST(OdometryFrame, StraightDrive_IsCountsTimesTheirLength) {
  FrameDrive drive;
  const OdometryPose pose = drive.go(101, 20);
  EXPECT_NEAR(pose.T_odom_base.x_m, 2000 * kCountLength_m, kCountLength_m);
  EXPECT_NEAR(pose.T_odom_base.y_m, 0, 1e-12);
  EXPECT_NEAR(pose.vx_m_s, 1000 * kCountLength_m, 1e-3);
  EXPECT_DOUBLE_EQ(pose.omega_rad_s, 0);
}

TEST(OdometryFrame, RestartedController_IsNoJump) {
  FrameDrive drive;
  drive.go(51, 20);
  drive.carry(-1'000'000);
  const OdometryPose pose = drive.go(50, 20);
  EXPECT_LE(drive.largest_step_m, 22 * kCountLength_m);
  EXPECT_GT(pose.T_odom_base.x_m, 60 * 20 * kCountLength_m) << "it drives on";
}

TEST(OdometryFrame, Gap_StandsStill) {
  FrameDrive drive;
  const double x_m = drive.go(51, 20).T_odom_base.x_m;
  drive.wait(3 * kNsPerSecond);
  drive.carry(1000);
  drive.go(10, 0);
  EXPECT_NEAR(drive.go(1, 0).T_odom_base.x_m, x_m, kCountLength_m);
}

TEST(OdometryFrame, FixElsewhere_IsNoJump) {
  FrameDrive drive;
  drive.go(50, 20);
  drive.odometer.advance(kNsPerSecond * 8 / 10, kNsPerSecond * 9 / 10, kNsPerSecond);
  drive.odometer.correct({5, 5, 1}, Covariance3::Identity() * 1e-6);
  const OdometryPose pose = drive.go(50, 20);
  EXPECT_LE(drive.largest_step_m, 22 * kCountLength_m);
  EXPECT_NEAR(pose.T_odom_base.x_m, 99 * 20 * kCountLength_m, kCountLength_m);
}

TEST(OdometryFrame, OtherRobot_KeepsThePose) {
  FrameDrive drive;
  const double x_m = drive.go(51, 20).T_odom_base.x_m;
  OdometryConfig other = with_wheels();
  other.geometry.track_m = 0.3;
  drive.odometer = Odometer(other);
  EXPECT_DOUBLE_EQ(drive.go(1, 0).T_odom_base.x_m, x_m);
  EXPECT_NEAR(drive.go(10, 20).T_odom_base.x_m, x_m + 200 * kCountLength_m, kCountLength_m);
}

TEST(OdometryFrame, OdometerThatIsReset_LosesNoMotion) {
  OdometryConfig coarse = with_wheels();
  coarse.geometry.counts_per_turn = 20;
  FrameDrive drive(coarse);
  for (int i = 0; i < 100; ++i) {
    drive.go(1, 1);
    drive.go(3, 0);
    drive.odometer.reset();
  }
  const double count_m = coarse.geometry.metres_per_count();
  EXPECT_NEAR(drive.go(1, 1).T_odom_base.x_m, 100 * count_m, 1.5 * count_m);
}

TEST(OdometryFrame, Disabled_HasNoMotion) {
  FrameDrive drive{OdometryConfig{}};
  EXPECT_EQ(drive.go(10, 20).t_ns, 0);
}

}  // namespace
}  // namespace cornerd::core
