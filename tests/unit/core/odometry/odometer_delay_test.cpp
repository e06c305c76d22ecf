// SPDX-License-Identifier: MIT
// Readings with a constant delay.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/odometry/odometer.hpp"
#include "tests/unit/core/odometry/driven_robot.hpp"

namespace cornerd::core {
namespace {

/// A minute with fixes; then five seconds without and five with fixes, alternating.
class LateRide {
 public:
  explicit LateRide(double delay_s, const OdometryConfig& config)
      : odometer(config), robot_(config.geometry, errors(), 5), delay_ns_(from_seconds(delay_s)) {}

  void teach() {
    for (int k = 0; k < 430; ++k) drive_scan(true);
  }
  /// Mean NEES of the predictions; 3 where they are consistent.
  double blind_nees() {
    constexpr int kScans = 35;
    double sum = 0;
    int count = 0;
    for (int k = 0; k < 20 * kScans; ++k) {
      const bool blind = k / kScans % 2 == 0;
      drive_scan(!blind);
      const auto predicted = odometer.prediction();
      EXPECT_TRUE(predicted) << k;
      if (!blind || !predicted) continue;
      sum += nees(*predicted);
      ++count;
    }
    return sum / count;
  }

  void drive_scan(bool with_fix) {
    constexpr double kReading_s = 0.02;
    const TimeNs start_ns = robot_.now_ns();
    TimeNs middle_ns = 0;
    for (int i = 0; i < 7; ++i, ++readings_) {
      const testing::Rates rates = testing::lively_drive(kReading_s * readings_);
      OdometryReading reading = robot_.drive(kReading_s, rates.speed_m_s, rates.rate_rad_s);
      reading.t_ns += delay_ns_;
      odometer.add(reading.arrived(robot_.now_ns()));
      if (i != 2) continue;
      middle_ns = robot_.now_ns();
      truth_ = robot_.truth();
    }
    odometer.advance(start_ns, middle_ns, robot_.now_ns());
    constexpr double kSigma = 5e-4;
    if (!with_fix) return;
    odometer.correct({truth_.x_m + kSigma * robot_.normal(), truth_.y_m + kSigma * robot_.normal(),
                      truth_.theta_rad + kSigma * robot_.normal()},
                     Covariance3::Identity() * kSigma * kSigma);
  }

  void delay_by(double delay_s) { delay_ns_ = from_seconds(delay_s); }

  /// Advances the lidar's time ahead of the readings.
  void advance_beyond(double ahead_s) {
    const TimeNs middle_ns = robot_.now_ns() + from_seconds(ahead_s);
    odometer.advance(middle_ns - 1000, middle_ns, middle_ns + 1000);
  }
  void read() { odometer.add(robot_.drive(0.02, 0.4, 0).arrived(robot_.now_ns())); }

  Odometer odometer;

 private:
  static testing::RobotErrors errors() {
    testing::RobotErrors errors;
    errors.left_scale = 0.015;
    errors.right_scale = 0.025;
    errors.gyro_scale = 0.02;
    errors.gyro_bias_rad_s = 0.01;
    errors.wheel_m_per_sqrt_m = 0.0012;
    errors.gyro_rad_s_per_sqrt_hz = 0.00025;
    return errors;
  }

  double nees(const PredictedPose& predicted) const {
    const Pose2& pose = predicted.T_map_base;
    const Eigen::Vector3d error(pose.x_m - truth_.x_m, pose.y_m - truth_.y_m,
                                angle_between(truth_.theta_rad, pose.theta_rad));
    return error.dot(predicted.covariance.inverse() * error);
  }

  testing::DrivenRobot robot_;
  TimeNs delay_ns_;
  Pose2 truth_;
  int readings_ = 0;
};

OdometryConfig config_of_late_ride() {
  OdometryConfig config;
  config.enabled = true;
  return config;
}

TEST(OdometerDelay, DelayedReadings_DelayIsEstimatedAndUsed) {
  for (const double delay_s : {0.0, 0.005, 0.02, -0.03, 0.08, -0.12, 0.17}) {
    LateRide ride(delay_s, config_of_late_ride());
    ride.teach();
    EXPECT_NEAR(ride.odometer.summary().parameters.delay_s, delay_s, 5e-4);
    EXPECT_LT(ride.odometer.summary().sigma.delay_s, 1e-3) << delay_s;
    const double nees = ride.blind_nees();
    EXPECT_LT(nees, 5) << delay_s;
    EXPECT_GT(nees, 0.5) << delay_s;
  }
}

TEST(OdometerDelay, DelayJumps_IsTracked) {
  for (const double jump_s : {-0.1, 0.05, 0.12}) {
    LateRide ride(0.01, config_of_late_ride());
    ride.teach();
    ride.delay_by(jump_s);
    ride.teach();
    EXPECT_NEAR(ride.odometer.summary().parameters.delay_s, jump_s, 1e-3);
    EXPECT_LT(ride.blind_nees(), 5) << jump_s;
  }
}

TEST(OdometerDelay, StationaryRobot_DelayIsNotEstimated) {
  const OdometryConfig config = config_of_late_ride();
  Odometer odometer(config);
  testing::RobotErrors errors;
  errors.gyro_bias_rad_s = 0.01;
  errors.gyro_rad_s_per_sqrt_hz = 0.001;
  testing::DrivenRobot robot(config.geometry, errors, 5);
  for (int k = 0; k < 2000; ++k) {
    const TimeNs start_ns = robot.now_ns();
    for (int i = 0; i < 7; ++i) odometer.add(robot.drive(0.02, 0, 0).arrived(robot.now_ns()));
    odometer.advance(start_ns, start_ns + 60'000'000, robot.now_ns());
    constexpr double kSigma = 1e-4;
    odometer.correct({kSigma * robot.normal(), kSigma * robot.normal(), kSigma * robot.normal()},
                     Covariance3::Identity() * kSigma * kSigma);
  }
  EXPECT_EQ(odometer.summary().parameters.delay_s, 0);
  EXPECT_GE(odometer.summary().sigma.delay_s, config.noise.delay_s);
}

TEST(OdometerDelay, ReadingsAfterScan_PredictionsFollowScan) {
  LateRide ride(0, config_of_late_ride());
  ride.teach();
  const TimeNs scan_ns = ride.odometer.prediction().value().t_ns;
  ride.advance_beyond(0.1);
  ASSERT_TRUE(ride.odometer.prediction());
  EXPECT_GT(ride.odometer.prediction()->t_ns, scan_ns);
  int before = 0;
  int after = 0;
  for (int i = 0; i < 20; ++i) {
    ride.read();
    const auto ahead = ride.odometer.predict_latest();
    if (!ahead) {
      ++before;
      continue;
    }
    ++after;
    EXPECT_GT(ahead->t_ns, ride.odometer.prediction()->t_ns) << i;
  }
  EXPECT_GT(before, 2);
  EXPECT_GT(after, 10);
}

TEST(OdometerDelay, ExtrapolationBeyondReadings_CovarianceGrows) {
  LateRide ride(0, config_of_late_ride());
  ride.teach();
  const Covariance3 read = ride.odometer.prediction().value().covariance;
  ride.advance_beyond(0.1);
  const Covariance3 guessed = ride.odometer.prediction().value().covariance;
  EXPECT_GT(guessed(2, 2) - read(2, 2), 0.08 * 0.08);
  EXPECT_GT(guessed(0, 0) - read(0, 0), 0.025 * 0.025);
  EXPECT_TRUE(ride.odometer.may_miss_motion());
}

/// Counterpart of the first test: without a prior sigma the delay is not estimated.
TEST(OdometerDelay, DelayFixed_ErrorsGoToWheels) {
  OdometryConfig config = config_of_late_ride();
  config.noise.delay_s = config.noise.delay_s_per_sqrt_s = 0;
  LateRide ride(0.005, config);
  ride.teach();
  EXPECT_NEAR(ride.odometer.summary().parameters.delay_s, 0, 1e-4);
  EXPECT_GT(ride.blind_nees(), 10);
}

TEST(OdometerDelay, ConfiguredDelay_IsInitial) {
  OdometryConfig config = config_of_late_ride();
  config.noise.delay_s = config.noise.delay_s_per_sqrt_s = 0;
  config.initial.delay_s = 0.02;
  LateRide ride(0.02, config);
  ride.teach();
  EXPECT_LT(ride.blind_nees(), 5);
}

TEST(OdometerDelay, DelayUnknown_CovarianceContainsItsPrior) {
  OdometryConfig sure = config_of_late_ride();
  sure.noise.delay_s = 0;
  MotionFilter doubting(config_of_late_ride());
  MotionFilter certain(sure);
  for (MotionFilter* const filter : {&doubting, &certain}) {
    const MotionFilter::Epoch moving{.velocity = {0.5, 0, 1}};
    filter->set_pose({}, Covariance3::Identity() * 1e-6, moving);
    // Right after a fix the delay's error is not in the pose.
    EXPECT_NEAR(filter->covariance_at(moving)(0, 0), 1e-6, 1e-9);
  }
  const Covariance3 more = doubting.covariance_at({}) - certain.covariance_at({});
  EXPECT_NEAR(more(0, 0), 0.005 * 0.005, 1e-9);
  EXPECT_NEAR(more(2, 2), 0.01 * 0.01, 1e-9);
}

}  // namespace
}  // namespace cornerd::core
