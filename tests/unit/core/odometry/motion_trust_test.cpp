// SPDX-License-Identifier: MIT
#include "core/odometry/motion_trust.hpp"

#include <gtest/gtest.h>

#include <random>

#include "driven_robot.hpp"

namespace cornerd::core {
namespace {

TEST(SensorTrust, RightMotions_AreTrusted) {
  SensorTrust trust;
  for (int i = 0; i < 3; ++i) trust.add({1e-4, 1e-4, 0.01});
  EXPECT_GT(trust.p_right(), 0.99);
}

TEST(SensorTrust, MotionsBelowNoise_TellNothing) {
  SensorTrust trust;
  const double before = trust.p_right();
  for (int i = 0; i < 100; ++i) trust.add({1e-4, 1e-4, 1e-8});
  EXPECT_NEAR(trust.p_right(), before, 0.01);
}

TEST(SensorTrust, OneSlip_IsForgivenAndARowIsNot) {
  SensorTrust trust;
  for (int i = 0; i < 10; ++i) trust.add({1e-4, 1e-4, 0.01});
  trust.add({0.01, 1e-4, 0.01});
  EXPECT_GT(trust.p_right(), 0.9);
  for (int i = 0; i < 3; ++i) trust.add({0.01, 1e-4, 0.01});
  EXPECT_LT(trust.p_right(), 0.1);
  for (int i = 0; i < 10; ++i) trust.add({1e-4, 1e-4, 0.01});
  EXPECT_GT(trust.p_right(), 0.99) << "repaired";
}

/// Twenty fixes of a robot that drives 5 cm and turns by 0.1 rad to each.
class TurningRobot {
 public:
  void drive(double left_share, double right_share, double gyro_share, int fixes = 20) {
    for (int i = 0; i < fixes; ++i) {
      OdometryIncrement step;
      step.from_ns = t_ns_;
      step.to_ns = t_ns_ += 140'000'000;
      step.left_m = left_share * (0.05 - 0.05 * config_.geometry.track_m);
      step.right_m = right_share * (0.05 + 0.05 * config_.geometry.track_m);
      step.gyro_rad = gyro_share * 0.1;
      step.has_gyro = true;
      trust.add(step, filter_);
      truth_ = truth_ * arc(0.05, 0.1);
      trust.add_fix(truth_, Covariance3::Identity() * 1e-6, filter_);
    }
  }
  MotionTrust trust{DriveGeometry{}};

 private:
  OdometryConfig config_ = testing::switched_on();
  MotionFilter filter_{config_};
  Pose2 truth_;
  TimeNs t_ns_ = 0;
};

TEST(MotionTrust, RightSensors_AreHealthyAndUsed) {
  TurningRobot robot;
  robot.drive(1, 1, 1);
  EXPECT_TRUE(robot.trust.is_healthy());
  EXPECT_TRUE(robot.trust.uses_gyro());
  EXPECT_TRUE(robot.trust.carries());
}

TEST(MotionTrust, GyroReversed_WheelsAreUsedInstead) {
  TurningRobot robot;
  robot.drive(1, 1, -1);
  EXPECT_FALSE(robot.trust.uses_gyro());
  EXPECT_TRUE(robot.trust.is_healthy());
}

TEST(MotionTrust, WheelDeadOrReversedOrOfOtherCounts_IsNotHealthy) {
  for (const auto& [left, right] :
       {std::pair{0.0, 1.0}, std::pair{-1.0, 1.0}, std::pair{4.0, 4.0}, std::pair{0.0, 0.0}}) {
    TurningRobot robot;
    robot.drive(left, right, 1);
    EXPECT_FALSE(robot.trust.is_healthy()) << left << ' ' << right;
  }
}

TEST(MotionTrust, SensorRepaired_IsHealthyAgain) {
  TurningRobot robot;
  robot.drive(-1, 1, 1);
  robot.drive(1, 1, 1, 60);
  EXPECT_TRUE(robot.trust.is_healthy());
}

TEST(MotionTrust, WheelsAndGyroDisagreeAfterFix_NothingIsCarried) {
  TurningRobot robot;
  robot.drive(1, 1, 1);
  const RotationComparison slip{.wheel_rad = 0.1, .gyro_rad = 0, .variance = 1e-6};
  for (int i = 0; i < 3; ++i) robot.trust.add_comparison(slip);
  EXPECT_TRUE(robot.trust.carries()) << "0.4 s of slip";
  for (int i = 0; i < 2; ++i) robot.trust.add_comparison(slip);
  EXPECT_FALSE(robot.trust.carries());
}

TEST(MotionTrust, GyroTurnsReversedOrInDegrees_NothingIsCarriedAtOnce) {
  for (const double gain : {-1.0, degrees(1)}) {
    TurningRobot robot;
    robot.drive(1, 1, 1);
    robot.trust.add_comparison({.wheel_rad = 0.1, .gyro_rad = gain * 0.1, .variance = 1e-6});
    EXPECT_FALSE(robot.trust.carries()) << gain;
  }
}

/// Rotations that are noise alone, by either sensor.
void stand(MotionTrust& trust, int scans) {
  constexpr double kSigma_rad = 1e-3;
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise_rad(0, kSigma_rad);
  for (int i = 0; i < scans; ++i) {
    trust.add_comparison({noise_rad(random), noise_rad(random), 2 * kSigma_rad * kSigma_rad});
    trust.add_comparison({0, noise_rad(random), kSigma_rad * kSigma_rad});
  }
}

TEST(MotionTrust, RobotThatStands_KeepsWhatIsKnownOfItsSensors) {
  TurningRobot robot;
  robot.drive(1, 1, 1);
  stand(robot.trust, 1000);
  EXPECT_TRUE(robot.trust.carries());
  for (int i = 0; i < 6; ++i) {
    robot.trust.add_comparison({.wheel_rad = 0.1, .gyro_rad = 0, .variance = 1e-6});
  }
  stand(robot.trust, 100);
  EXPECT_FALSE(robot.trust.carries());
}

}  // namespace
}  // namespace cornerd::core
