// SPDX-License-Identifier: MIT
#include "core/odometry/motion_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace cornerd::core {
namespace {

constexpr DriveGeometry kGeometry;
constexpr OdometryParameters kAt{.gyro_bias_rad_s = 0.02,
                                 .left_scale = 0.015,
                                 .right_scale = -0.02,
                                 .track_scale = 0.03,
                                 .gyro_scale = -0.01,
                                 .delay_s = 0};
constexpr MotionNoise kNoise{2e-6, 1e-6, 1e-7};
constexpr TimeNs kStep_ns = 20'000'000;

/// A bend that changes its speed and rate; the wheels' rotation is about the gyro's.
std::vector<OdometryIncrement> bend(bool has_gyro, int steps = 7) {
  std::vector<OdometryIncrement> drive;
  for (int i = 0; i < steps; ++i) {
    OdometryIncrement step;
    step.from_ns = i * kStep_ns;
    step.to_ns = step.from_ns + kStep_ns;
    const double way_m = 0.008 + 0.0005 * i;
    const double turn_rad = 0.03 - 0.002 * i;
    step.left_m = way_m - turn_rad * kGeometry.track_m / 2;
    step.right_m = way_m + turn_rad * kGeometry.track_m / 2;
    step.gyro_rad = 1.01 * turn_rad;
    step.has_gyro = has_gyro;
    drive.push_back(step);
  }
  return drive;
}

MotionFactor factor_of(std::span<const OdometryIncrement> steps, const OdometryParameters& at,
                       const MotionNoise& noise = kNoise) {
  MotionFactor factor(kGeometry, at, noise);
  for (const OdometryIncrement& step : steps) factor.add(step);
  return factor;
}

MotionFactor::Column values_of(const MotionFactor& factor) {
  const Pose2 motion = factor.motion();
  return {motion.x_m, motion.y_m, factor.rotation_rad(), factor.wheel_rotation_rad()};
}

double& parameter(OdometryParameters& of, int index) {
  double* const all[] = {&of.gyro_bias_rad_s, &of.left_scale, &of.right_scale, &of.track_scale,
                         &of.gyro_scale};
  return *all[index];
}

TEST(MotionFactor, Parameters_SlopesAreDifferences) {
  for (const bool has_gyro : {true, false}) {
    const auto steps = bend(has_gyro);
    const MotionFactor factor = factor_of(steps, kAt);
    constexpr double kChange = 1e-6;
    for (int i = MotionFactor::kBias; i <= MotionFactor::kGyro; ++i) {
      OdometryParameters more = kAt;
      OdometryParameters less = kAt;
      parameter(more, i) += kChange;
      parameter(less, i) -= kChange;
      const MotionFactor::Column slope =
          (values_of(factor_of(steps, more)) - values_of(factor_of(steps, less))) / (2 * kChange);
      EXPECT_LT((factor.jacobian().col(i) - slope).norm(), 1e-7) << has_gyro << ' ' << i;
    }
  }
}

/// What a wheel rolled beyond its counts at an end is travel that the counts do not show.
TEST(MotionFactor, PositionsWithinCounts_SlopesAreDifferences) {
  for (const bool has_gyro : {true, false}) {
    const auto steps = bend(has_gyro);
    const MotionFactor factor = factor_of(steps, {});
    constexpr double kChange_m = 1e-6;
    for (const bool is_left : {true, false}) {
      const auto slope = [&](std::size_t step, double change_m) {
        auto changed = steps;
        (is_left ? changed[step].left_m : changed[step].right_m) += change_m;
        return MotionFactor::Column((values_of(factor_of(changed, {})) - values_of(factor)) /
                                    kChange_m);
      };
      const int start = is_left ? MotionFactor::kLeftRest : MotionFactor::kRightRest;
      // The rest of the first step's way turns with it, half a step's rotation later.
      EXPECT_LT((factor.jacobian().col(start) - slope(0, -kChange_m)).norm(), 1e-4) << has_gyro;
      EXPECT_LT((factor.end_slope().col(is_left ? 0 : 1) - slope(6, kChange_m)).norm(), 0.06)
          << has_gyro;
    }
  }
}

TEST(MotionFactor, TimeOffset_SlopeIsDifference) {
  for (const bool has_gyro : {true, false}) {
    const auto steps = bend(has_gyro, 9);
    const auto between = [&](TimeNs from_ns, TimeNs to_ns) {
      MotionFactor factor(kGeometry, kAt);
      for (OdometryIncrement step : steps) {
        if (step.to_ns <= from_ns || step.from_ns >= to_ns) continue;
        if (step.from_ns < from_ns) step.split(from_ns);
        if (step.to_ns > to_ns) step = step.split(to_ns);
        factor.add(step);
      }
      return factor;
    };
    // Within a reading's interval, so that both ends' velocities stay.
    constexpr TimeNs kOffset_ns = 2'000'000;
    const TimeNs from_ns = kStep_ns / 2;
    const TimeNs to_ns = from_ns + 7 * kStep_ns;
    const MotionFactor::Column slope =
        (values_of(between(from_ns + kOffset_ns, to_ns + kOffset_ns)) -
         values_of(between(from_ns - kOffset_ns, to_ns - kOffset_ns))) /
        (2 * to_seconds(kOffset_ns));
    EXPECT_LT((between(from_ns, to_ns).delay_slope() - slope).norm(), 2e-3) << has_gyro;
  }
}

TEST(MotionFactor, NoisySteps_CovarianceIsThatOfTheirMotions) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (const bool has_gyro : {true, false}) {
    const auto steps = bend(has_gyro);
    const MotionFactor factor = factor_of(steps, {});
    constexpr int kDrives = 20'000;
    MotionFactor::Covariance sum = MotionFactor::Covariance::Zero();
    for (int drive = 0; drive < kDrives; ++drive) {
      auto noisy = steps;
      for (OdometryIncrement& step : noisy) {
        const double scrub_m = kGeometry.track_m / 2 * normal(random) *
                               std::sqrt(kNoise.scrub_rad2_per_rad *
                                         std::abs(step.right_m - step.left_m) / kGeometry.track_m);
        step.left_m += normal(random) * std::sqrt(kNoise.wheel_m2_per_m * step.left_m) - scrub_m;
        step.right_m += normal(random) * std::sqrt(kNoise.wheel_m2_per_m * step.right_m) + scrub_m;
        step.gyro_rad += normal(random) * std::sqrt(kNoise.gyro_rad2_per_s * step.duration_s());
      }
      const MotionFactor::Column off = values_of(factor_of(noisy, {})) - values_of(factor);
      sum += off * off.transpose() / kDrives;
    }
    const Eigen::Vector4d sigma = factor.covariance().diagonal().cwiseSqrt();
    const auto scaled = [&](const MotionFactor::Covariance& covariance) {
      return MotionFactor::Covariance(sigma.cwiseInverse().asDiagonal() * covariance *
                                      sigma.cwiseInverse().asDiagonal());
    };
    EXPECT_LT((scaled(sum) - scaled(factor.covariance())).cwiseAbs().maxCoeff(), 0.04) << has_gyro;
  }
}

/// Counts telescope: how often they are read changes the motion by the midpoint rule's error alone.
TEST(MotionFactor, FinerSteps_MotionAndSlopesStay) {
  const auto whole = bend(true);
  std::vector<OdometryIncrement> parts;
  for (OdometryIncrement step : whole) {
    parts.push_back(step.split((step.from_ns + step.to_ns) / 2));
    parts.push_back(step);
  }
  const MotionFactor coarse = factor_of(whole, kAt);
  const MotionFactor fine = factor_of(parts, kAt);
  EXPECT_LT((values_of(coarse) - values_of(fine)).norm(), 1e-5);
  EXPECT_LT((coarse.jacobian() - fine.jacobian()).norm(), 0.02);
  EXPECT_LT((coarse.covariance() - fine.covariance()).norm(), 0.01 * coarse.covariance().norm());
  EXPECT_DOUBLE_EQ(coarse.rolled_m(), fine.rolled_m());
}

TEST(MotionFactor, GyroInSomeSteps_OthersAreByWheels) {
  auto steps = bend(true);
  EXPECT_TRUE(factor_of(steps, {}).has_gyro());
  steps[3].has_gyro = false;
  const double all_rad = factor_of(bend(true), {}).rotation_rad();
  const MotionFactor factor = factor_of(steps, {});
  EXPECT_FALSE(factor.has_gyro());
  const double wheels_rad = (steps[3].right_m - steps[3].left_m) / kGeometry.track_m;
  EXPECT_NEAR(factor.rotation_rad(), all_rad - steps[3].gyro_rad + wheels_rad, 1e-12);
}

}  // namespace
}  // namespace cornerd::core
