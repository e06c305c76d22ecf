// SPDX-License-Identifier: MIT
#include "core/odometry/motion_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "filtered_drive.hpp"

namespace cornerd::core {
namespace {

using testing::config_with_counts_of_5_mm;
using testing::kFixSigma_m;
using testing::nominal_errors;
using testing::switched_on;
using Drive = testing::FilteredDrive;

TEST(MotionFilter, ThirtySecondsOfFixes_ScalesAndBiasAreEstimated) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const testing::RobotErrors errors = nominal_errors();
    Drive drive(switched_on(), errors, seed);
    drive.drive(30, true);
    const OdometryParameters learned = drive.filter().parameters();
    EXPECT_NEAR(learned.left_scale, errors.left_scale, 0.003) << seed;
    EXPECT_NEAR(learned.right_scale, errors.right_scale, 0.003) << seed;
    EXPECT_NEAR(learned.gyro_scale, errors.gyro_scale, 0.003) << seed;
    EXPECT_NEAR(learned.track_scale, 0, 0.004) << seed;
    EXPECT_NEAR(learned.gyro_bias_rad_s, errors.gyro_bias_rad_s, 0.001) << seed;
  }
}

TEST(MotionFilter, FiveSecondsWithoutFixes_ErrorBelow3cm) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drive drive(switched_on(), nominal_errors(), seed);
    drive.drive(30, true);
    drive.drive(5, false);
    EXPECT_LT(drive.error().head<2>().norm(), 0.03) << seed;
    EXPECT_LT(std::abs(drive.error().z()), radians(1)) << seed;
  }
}

TEST(MotionFilter, ParametersChange_AreEstimatedAgain) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    testing::RobotErrors errors = nominal_errors();
    Drive drive(switched_on(), errors, seed);
    drive.drive(60, true);
    errors.left_scale += 0.02;
    errors.right_scale += 0.02;
    errors.gyro_bias_rad_s -= 0.01;
    drive.robot().change(errors);
    drive.drive(20, true);
    const OdometryParameters learned = drive.filter().parameters();
    EXPECT_NEAR(learned.left_scale, errors.left_scale, 0.005) << seed;
    EXPECT_NEAR(learned.right_scale, errors.right_scale, 0.005) << seed;
    EXPECT_NEAR(learned.gyro_bias_rad_s, errors.gyro_bias_rad_s, 0.001) << seed;
  }
}

TEST(MotionFilter, SlipsSeenByGyro_AreKnownWhenItIsMissing) {
  const auto slip_rad2_per_m = [](double slip_share) {
    testing::RobotErrors errors = nominal_errors();
    Drive drive(switched_on(), errors, 1);
    for (int i = 0; i < 10; ++i) {
      drive.drive(3, true);
      testing::RobotErrors slipping = errors;
      slipping.left_scale += slip_share;
      drive.robot().change(slipping);
      drive.drive(0.2, true);
      drive.robot().change(errors);
    }
    drive.drive(0.2, false, /*with_gyro=*/false);
    return drive.filter().noise(1).slip_rad2_per_m;
  };
  EXPECT_GT(slip_rad2_per_m(0.6), 10 * slip_rad2_per_m(0));
}

TEST(MotionFilter, ParametersConstant_CovarianceIsNotInflated) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drive drive(switched_on(), nominal_errors(), seed);
    drive.drive(60, true);
    const MotionFilter::Vector before = drive.filter().covariance().diagonal();
    drive.drive(60, true);
    const MotionFilter::Vector after = drive.filter().covariance().diagonal();
    for (const int index : {MotionFilter::kBias, MotionFilter::kLeft, MotionFilter::kRight}) {
      EXPECT_LT(after[index], 1.5 * before[index]) << seed << ' ' << index;
    }
  }
}

TEST(MotionFilter, CoarseCounts_QuantizationDoesNotAccumulate) {
  // The travel between two counts is off by 1.4 mm at each end, however many lie in between.
  const OdometryConfig config = config_with_counts_of_5_mm();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drive drive(config, nominal_errors(), seed);
    drive.drive(30, true);
    EXPECT_NEAR(drive.filter().parameters().left_scale, 0.015, 0.004) << seed;
    EXPECT_NEAR(drive.filter().parameters().right_scale, 0.025, 0.004) << seed;
    drive.drive(5, false);
    EXPECT_LT(drive.error().head<2>().norm(), 0.02) << seed;
    EXPECT_LT(std::sqrt(drive.filter().covariance_at({})(0, 0)), 0.02) << seed;
  }
}

// In most scans no wheel comes to another count, and the gyro turns on.
TEST(MotionFilter, SlowRotation_IsNoNoiseOfWheels) {
  OdometryConfig config = switched_on();
  config.geometry.counts_per_turn = 360;
  Drive drive(config, nominal_errors(), 1);
  drive.drive(60, true, true, testing::Rates{0, 0.02});
  const double modelled = config.noise.wheel_m_per_sqrt_m * config.noise.wheel_m_per_sqrt_m;
  EXPECT_LT(drive.filter().noise(0).wheel_m2_per_m / modelled, 8);
}

TEST(MotionFilter, WithFixes_ErrorBelowFixNoise) {
  double squares_m2 = 0;
  int count = 0;
  Drive drive(switched_on(), nominal_errors(), 3);
  drive.drive(20, true);
  for (int i = 0; i < 300; ++i, ++count) {
    drive.drive(0.14, true);
    squares_m2 += drive.error().head<2>().squaredNorm();
  }
  EXPECT_LT(std::sqrt(squares_m2 / count), kFixSigma_m * std::sqrt(2.0));
}

TEST(MotionFilter, WheelSpinsFree_HeadingIsUnchanged) {
  const OdometryConfig config = switched_on();
  Drive drive(config, nominal_errors(), 4);
  drive.drive(30, true);
  const OdometryParameters before = drive.filter().parameters();
  const Pose2 start = drive.filter().pose();
  const std::uint64_t slips = drive.filter().slips();
  OdometryIncrement slip;
  slip.to_ns = kNsPerSecond / 50;
  slip.right_m = 0.02;
  slip.has_gyro = true;
  slip.gyro_rad = before.gyro_bias_rad_s * slip.duration_s();
  for (int i = 0; i < 25; ++i) {
    drive.filter().add(slip);
    drive.filter().advance();
  }
  EXPECT_EQ(drive.filter().slips() - slips, 25U);
  EXPECT_LT(std::abs(angle_between(start.theta_rad, drive.filter().pose().theta_rad)), 0.02);
  EXPECT_NEAR(drive.filter().parameters().right_scale, before.right_scale, 0.002);
  EXPECT_NEAR(drive.filter().parameters().gyro_bias_rad_s, before.gyro_bias_rad_s, 0.001);
  EXPECT_LT((drive.filter().pose().translation() - start.translation()).norm(), 0.03);
  EXPECT_TRUE(drive.correct());  // half a metre of free spinning makes the covariance large enough
}

TEST(MotionFilter, NisAboveGate_FixIsRejected) {
  Drive drive(switched_on(), nominal_errors(), 5);
  drive.drive(10, true);
  const MotionFilter before = drive.filter();
  Pose2 elsewhere = drive.robot().truth();
  elsewhere.x_m += 0.5;
  EXPECT_FALSE(drive.filter().correct(elsewhere, Covariance3::Identity() * 1e-6, {}));
  EXPECT_EQ(drive.filter().pose().translation(), before.pose().translation());
  EXPECT_EQ(drive.filter().parameters().left_scale, before.parameters().left_scale);
  EXPECT_EQ(drive.filter().covariance(), before.covariance());
}

TEST(MotionFilter, Gap_CovarianceGrowsAndParametersStay) {
  Drive drive(switched_on(), nominal_errors(), 6);
  drive.drive(30, true);
  const OdometryParameters before = drive.filter().parameters();
  OdometryIncrement hole;
  hole.to_ns = 2 * kNsPerSecond;
  hole.is_gap = true;
  drive.filter().add(hole);
  EXPECT_GT(drive.filter().covariance_at({})(0, 0), 0.25);
  EXPECT_EQ(drive.filter().parameters().left_scale, before.left_scale);
}

}  // namespace
}  // namespace cornerd::core
