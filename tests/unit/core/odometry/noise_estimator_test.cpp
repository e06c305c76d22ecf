// SPDX-License-Identifier: MIT
#include "core/odometry/noise_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cornerd::core {
namespace {

/// Residuals with `factor` times the modelled variance of 1, among other noise `other`.
double learned(double factor, double other, int observations, double outlier = 0) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0, std::sqrt(factor + other));
  NoiseEstimator estimator(8, 0.01, 100);
  for (int i = 0; i < observations; ++i) {
    const double residual = i % 40 == 20 && outlier > 0 ? outlier : normal(random);
    estimator.add(residual * residual, 1, other);
  }
  return estimator.factor();
}

TEST(NoiseEstimator, Residuals_NoiseScaleIsEstimated) {
  EXPECT_NEAR(learned(4, 0.5, 400), 4, 1.2);
  EXPECT_NEAR(learned(0.1, 0.02, 400), 0.1, 0.03);
}

TEST(NoiseEstimator, NoiseBelowFixNoise_EstimateIsUnchanged) {
  EXPECT_NEAR(learned(4, 1000, 400), 1, 0.5);
}

TEST(NoiseEstimator, FewResiduals_EstimateChangesLittle) { EXPECT_NEAR(learned(0.1, 0, 2), 1, 0.25); }

TEST(NoiseEstimator, Outliers_CountAsFourSigma) { EXPECT_LT(learned(1, 0.1, 400, 1000), 2.5); }

TEST(NoiseEstimator, NoResiduals_EstimateIsUnchanged) {
  NoiseEstimator estimator(8, 0.01, 100);
  estimator.add(5, 0, 1);
  EXPECT_EQ(estimator.factor(), 1);
}

}  // namespace
}  // namespace cornerd::core
