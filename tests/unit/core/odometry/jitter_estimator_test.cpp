// SPDX-License-Identifier: MIT
#include "core/odometry/jitter_estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace cornerd::core {
namespace {

constexpr double kPeriod_s = 0.02;

/// Standard deviation of a reading's time, s, after a minute at 50 readings a second. `way_m`: of
/// both wheels, by the true time.
template <typename Way>
double estimated_s(double jitter_s, double count_m, const Way& way_m) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0, 1);
  JitterEstimator estimator;
  double stamp_s = 0;
  double counted_m = 0;
  for (int i = 1; i < 3000; ++i) {
    const double t_s = i * kPeriod_s;
    const double stamped_s = t_s + jitter_s * std::clamp(normal(random), -3.0, 3.0);
    const double reached_m = count_m > 0 ? count_m * std::floor(way_m(t_s) / count_m) : way_m(t_s);
    estimator.add(reached_m - counted_m, reached_m - counted_m, stamped_s - stamp_s,
                  count_m * count_m / 12);
    stamp_s = stamped_s;
    counted_m = reached_m;
  }
  return std::sqrt(1.5 * estimator.variance_between_s2());
}

double evenly_m(double t_s) { return 0.4 * t_s; }
double changing_m(double t_s) { return 0.4 * t_s + 0.1 * std::sin(2 * t_s); }

TEST(JitterEstimator, JitteringTimes_AreMeasured) {
  EXPECT_NEAR(estimated_s(0.002, 0, evenly_m), 0.002, 0.0003);
  EXPECT_NEAR(estimated_s(0.004, 0.0001, changing_m), 0.004, 0.0006);
}

TEST(JitterEstimator, ExactTimes_NoJitter) {
  EXPECT_LT(estimated_s(0, 0.0001, evenly_m), 0.0002);
  EXPECT_LT(estimated_s(0, 0, changing_m), 0.0002);
}

// At one and a half counts a reading the rounding alternates.
TEST(JitterEstimator, CoarseCounts_PassForNoJitter) {
  EXPECT_LT(estimated_s(0, 0.4 * kPeriod_s / 1.5, evenly_m), 0.001);
}

TEST(JitterEstimator, Interrupted_SpeedsAreNotCompared) {
  JitterEstimator estimator;
  for (int i = 0; i < 1000; ++i) {
    const double way_m = i % 2 == 0 ? 0.01 : 0.02;
    estimator.add(way_m, way_m, kPeriod_s, 0);
    estimator.interrupt();
  }
  EXPECT_EQ(estimator.variance_between_s2(), 0);
}

}  // namespace
}  // namespace cornerd::core
