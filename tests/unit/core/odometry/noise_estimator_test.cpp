// SPDX-License-Identifier: MIT
#include "core/odometry/noise_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

}  // namespace
}  // namespace cornerd::core
