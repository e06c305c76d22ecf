// SPDX-License-Identifier: MIT
#include "core/breakpoint/line_fit.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cornerd::core {
namespace {

TEST(LineFit, PointsOnALine_FitIsExactInEveryDirection) {
  for (int k = 0; k < 360; k += 7) {
    const Vec2 normal = unit_vector(radians(k));
    const Vec2 along = rotate_left(normal);
    LineFit fit(-2.0 * normal);
    for (int i = 0; i < 10; ++i) {
      const Vec2 p = -2.0 * normal + (0.05 * i - 0.3) * along;
      fit.add(p.x(), p.y(), 100);
    }
    const Line line = fit.line();
    EXPECT_LT((line.normal - normal).norm(), 1e-9) << k;  // towards the sensor at the origin
    EXPECT_NEAR(line.offset_m, -2, 1e-12);
    EXPECT_NEAR(fit.chi_square(), 0, 1e-9);
    EXPECT_GT(cross(line.direction(), line.normal), 0);
  }
}

TEST(LineFit, RemovedPoint_FitIsUnchanged) {
  LineFit with;
  LineFit without;
  const double xs[] = {1, 1.1, 1.2, 1.3};
  for (const double x : xs) {
    with.add(x, 2 + 0.1 * x, 4);
    without.add(x, 2 + 0.1 * x, 4);
  }
  with.add(7, -3, 2);
  with.remove(7, -3, 2);
  EXPECT_EQ(with.count(), without.count());
  EXPECT_NEAR(with.line().offset_m, without.line().offset_m, 1e-12);
  EXPECT_LT((with.line().normal - without.line().normal).norm(), 1e-12);
}

TEST(LineFit, TwoPartsAdded_EqualsOneFit) {
  LineFit whole({1, 1});
  LineFit a({1, 1});
  LineFit b({2, 5});
  for (int i = 0; i < 20; ++i) {
    const double x = 0.1 * i;
    const double y = 1 + 0.3 * x + ((i % 3) - 1) * 0.01;
    whole.add(x, y, 1 + i);
    (i < 8 ? a : b).add(x, y, 1 + i);
  }
  a.add(b);
  EXPECT_NEAR(a.line().offset_m, whole.line().offset_m, 1e-12);
  EXPECT_NEAR(a.chi_square(), whole.chi_square(), 1e-9);
}

TEST(LineFit, StatedVariance_MatchesMonteCarlo) {
  constexpr double kSigma_m = 0.005;
  std::mt19937 random(2);
  std::normal_distribution<double> noise(0, kSigma_m);
  double squares = 0;
  double stated = 0;
  constexpr int kFits = 4000;
  for (int k = 0; k < kFits; ++k) {
    LineFit fit({0, -1});
    for (int i = 0; i < 12; ++i) fit.add(0.02 * i, -1 + noise(random), 1 / (kSigma_m * kSigma_m));
    const Line line = fit.line();
    const double along = line.direction().dot(Vec2(0.4, -1) - line.centroid);
    const double error = line.normal.dot(Vec2(0.4, -1)) - line.offset_m;
    squares += error * error;
    stated += line.variance_at(along);
  }
  EXPECT_NEAR(squares / stated, 1, 0.1);
}

}  // namespace
}  // namespace cornerd::core
