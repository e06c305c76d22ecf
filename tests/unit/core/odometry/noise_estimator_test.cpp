// SPDX-License-Identifier: MIT
#include "core/odometry/noise_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace cornerd::core {
namespace {

/// Residuals with `factor` times the modelled variance of 1, among other noise `other`.
double estimated(double factor, double other, int observations, double outlier = 0) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0, std::sqrt(factor + other));
  NoiseEstimator estimator(0.01, 100);
  for (int i = 0; i < observations; ++i) {
    const double residual = i % 40 == 20 && outlier > 0 ? outlier : normal(random);
    estimator.add(residual * residual, 1, other);
  }
  return estimator.factor();
}

double of_prior() { return NoiseEstimator(0.01, 100).factor(); }

TEST(NoiseEstimator, Residuals_NoiseScaleIsEstimated) {
  EXPECT_NEAR(estimated(4, 0.5, 400), 4, 1.2);
  EXPECT_NEAR(estimated(0.1, 0.02, 400), 0.1, 0.03);
}

// In residuals with twenty times as much of other noise.
TEST(NoiseEstimator, NoiseFarBeyondModel_FewResidualsSuffice) {
  EXPECT_GT(estimated(64, 20, 40), 30);
}

TEST(NoiseEstimator, NoiseBelowOtherNoise_EstimateIsThePriors) {
  EXPECT_NEAR(estimated(4, 10'000, 400), of_prior(), 0.1 * of_prior());
}

TEST(NoiseEstimator, FewResiduals_EstimateIsBetweenPriorAndThem) {
  EXPECT_LT(estimated(0.1, 0, 2), of_prior());
  EXPECT_GT(estimated(0.1, 0, 2), 0.15);
}

TEST(NoiseEstimator, Outliers_CountAsFourSigma) { EXPECT_LT(estimated(1, 0.1, 400, 1000), 2.5); }

TEST(NoiseEstimator, NoModelledNoise_EstimateIsUnchanged) {
  NoiseEstimator estimator(0.01, 100);
  estimator.add(5, 0, 1);
  EXPECT_EQ(estimator.factor(), of_prior());
}

struct Estimated {
  double factor = 0;
  double floor = 0;
};

/// Measurements of a walk of `factor` times the modelled variance of 1, each off by white noise of
/// `floor` times 4; as the means of the walk over the time since the one before, if `averaged`.
/// `gain`: of the filter that is adapted, from 1, which starts anew from each of them. Of every ten
/// steps it walks in `walking`.
Estimated estimated_walk(double factor, double floor, double gain, bool averaged = false,
                         int walking = 10) {
  constexpr int kSteps = 50;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  WalkNoiseEstimator estimator(0.1, 100, 0.03);
  double walk = 0;
  double sum = 0;
  double walked_before = 1;
  for (int i = 0; i < 1000; ++i) {
    const double walks = i % 10 < walking ? 1 : 0;
    // From the middle of one step to that of the next.
    const double walked = (std::exchange(walked_before, walks) + walks) / 2;
    double mean = 0;
    for (int k = 0; k < kSteps; ++k) {
      walk += walks * std::sqrt(factor / kSteps) * normal(random);
      mean += walk / kSteps;
    }
    const double measured = (averaged ? mean : walk) + 2 * std::sqrt(floor) * normal(random);
    const WalkStep step{.innovation = measured - sum,
                        .correction = gain * (measured - sum),
                        .walk = averaged ? walked : walks,
                        .averaged = averaged ? walked : 0,
                        .floor = 4};
    if (i == 0) {
      estimator.restart(step);
      sum = measured;
    } else {
      estimator.add(step);
      sum += step.correction;
    }
  }
  return {estimator.factor(), estimator.floor()};
}

/// Factors that are tried are 1.9 times each other.
constexpr double kLogStep = 0.34;

// The innovations of both have the same mean square, 8.2.
TEST(NoiseEstimator, WalkAndWhiteNoise_AreToldApart) {
  for (const double gain : {1.0, 0.3}) {
    const Estimated much_walk = estimated_walk(8, 0.03, gain);
    EXPECT_NEAR(std::log(much_walk.factor), std::log(8), kLogStep) << gain;
    EXPECT_LT(much_walk.floor, 0.2) << gain;
    const Estimated much_noise = estimated_walk(0.8, 0.93, gain);
    EXPECT_NEAR(std::log(much_noise.factor), std::log(0.8), kLogStep) << gain;
    EXPECT_GT(much_noise.floor, 0.8) << gain;
  }
}

TEST(NoiseEstimator, MeansOfWalk_FactorIsThatOfWalk) {
  for (const int walking : {10, 5, 1}) {
    const double factor = estimated_walk(4, 0.05, 1, true, walking).factor;
    EXPECT_NEAR(std::log(factor), std::log(4), kLogStep) << walking;
  }
}

TEST(NoiseEstimator, OtherMeasurements_FactorStaysAndFloorIsTheirs) {
  WalkNoiseEstimator wheels(0.1, 100, 0.03);
  WalkNoiseEstimator gyro(0.1, 100, 0.03);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    const double walked = 3 * normal(random);
    wheels.add(WalkStep{.innovation = walked, .correction = walked, .walk = 1, .floor = 4});
    // Jumps to and fro are no walk.
    const double jump = i % 2 == 0 ? 2 : -2;
    gyro.add(WalkStep{.innovation = jump, .correction = jump, .walk = 0.01, .floor = 1});
  }
  const double factor = wheels.factor();
  ASSERT_LT(wheels.floor(), 0.5);
  ASSERT_GT(gyro.floor(), 0.9);
  wheels.take_floor(gyro);
  EXPECT_NEAR(wheels.factor(), factor, 0.2 * factor);
  EXPECT_NEAR(wheels.floor(), gyro.floor(), 0.05);
}

TEST(NoiseEstimator, NothingKnownOrMeasured_FactorsStayFinite) {
  WalkNoiseEstimator estimator(0.1, 100, 0.03);
  for (int i = 0; i < 3; ++i) estimator.add(WalkStep{});
  EXPECT_TRUE(std::isfinite(estimator.factor()) && std::isfinite(estimator.floor()));
}

}  // namespace
}  // namespace cornerd::core
