// SPDX-License-Identifier: MIT
#include "core/odometry/odometry_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cornerd::core {
namespace {

constexpr DriveGeometry kWheels{0.05, 0.2, 1000, 0};

OdometryConfig with_wheels() {
  OdometryConfig config;
  config.enabled = true;
  config.geometry = kWheels;
  return config;
}

/// Readings at 50 Hz of a robot that drives with these counts a reading.
class FrameDrive {
 public:
  explicit FrameDrive(OdometryFrame& frame) : frame_(frame) {}
  OdometryPose go(int readings, std::int64_t left, std::int64_t right,
                  const OdometryParameters& parameters = {}) {
    for (int i = 0; i < readings; ++i) {
      t_ns_ += kNsPerSecond / 50;
      left_ += left;
      right_ += right;
      const OdometryPose* pose =
          frame_.add({t_ns_, left_, right_, std::nullopt, t_ns_}, parameters);
      if (pose == nullptr) continue;
      largest_step_m_ =
          std::max(largest_step_m_,
                   (pose->T_odom_base.translation() - last_.T_odom_base.translation()).norm());
      last_ = *pose;
    }
    return last_;
  }
  void pause(double seconds) { t_ns_ += from_seconds(seconds); }
  void carry(std::int64_t counts) {
    left_ += counts;
    right_ += counts;
  }
  double largest_step_m() const { return largest_step_m_; }

 private:
  OdometryFrame& frame_;
  TimeNs t_ns_ = 0;
  std::int64_t left_ = 0;
  std::int64_t right_ = 0;
  OdometryPose last_;
  double largest_step_m_ = 0;
};

TEST(OdometryFrame, StraightDrive_IsCountsTimesTheirLength) {
  OdometryFrame frame(with_wheels());
  FrameDrive drive(frame);
  const OdometryPose pose = drive.go(101, 20, 20);
  EXPECT_NEAR(pose.T_odom_base.x_m, 2000 * kWheels.metres_per_count(), 1e-9);
  EXPECT_NEAR(pose.T_odom_base.y_m, 0, 1e-12);
  EXPECT_NEAR(pose.vx_m_s, 1000 * kWheels.metres_per_count(), 1e-9);
  EXPECT_DOUBLE_EQ(pose.omega_rad_s, 0);
}

TEST(OdometryFrame, BetterParameters_HoldFromNowOnAndDoNotJump) {
  OdometryFrame frame(with_wheels());
  FrameDrive drive(frame);
  drive.go(51, 20, 20);
  const double step_m = 20 * kWheels.metres_per_count();
  OdometryParameters learned;
  learned.left_scale = learned.right_scale = 0.1;
  const OdometryPose pose = drive.go(50, 20, 20, learned);
  EXPECT_NEAR(pose.T_odom_base.x_m, 50 * step_m + 50 * 1.1 * step_m, 1e-9);
  EXPECT_LE(drive.largest_step_m(), 1.1 * step_m + 1e-12);
}

TEST(OdometryFrame, RestartedController_IsNoJump) {
  OdometryFrame frame(with_wheels());
  FrameDrive drive(frame);
  drive.go(51, 20, 20);
  drive.carry(-1'000'000);
  const OdometryPose pose = drive.go(50, 20, 20);
  EXPECT_LE(drive.largest_step_m(), 21 * kWheels.metres_per_count());
  EXPECT_GT(pose.T_odom_base.x_m, 60 * 20 * kWheels.metres_per_count()) << "it drives on";
}

TEST(OdometryFrame, OtherConfig_KeepsThePose) {
  OdometryFrame frame(with_wheels());
  FrameDrive drive(frame);
  const double x_m = drive.go(51, 20, 20).T_odom_base.x_m;
  OdometryConfig other = with_wheels();
  other.geometry.track_m = 0.3;
  frame.configure(other);
  EXPECT_DOUBLE_EQ(drive.go(1, 0, 0).T_odom_base.x_m, x_m);
  EXPECT_NEAR(drive.go(10, 20, 20).T_odom_base.x_m, x_m + 200 * kWheels.metres_per_count(), 1e-9);
}

TEST(OdometryFrame, Disabled_HasNoPose) {
  OdometryFrame frame(OdometryConfig{});
  EXPECT_EQ(frame.add({1, 2, 3, {}, 1}, {}), nullptr);
  EXPECT_EQ(frame.add({kNsPerSecond, 9, 9, {}, kNsPerSecond}, {}), nullptr);
}

}  // namespace
}  // namespace cornerd::core
