// SPDX-License-Identifier: MIT
#include "core/estimate/line_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace cornerd::core {
namespace {

/// Of points (lever, distance), all of weight 4.
LineSums sums_of(const std::vector<std::pair<double, double>>& points) {
  LineSums sums;
  for (const auto& [lever, distance] : points) {
    sums.add({4, 4 * lever, 4 * lever * lever, 4 * distance, 4 * lever * distance});
  }
  return sums;
}

TEST(LineSums, PointsOnATurnedLine_DirectionIsItsAngleWhateverItsOffset) {
  const LineSums sums = sums_of({{1, 0.52}, {2, 0.53}, {4, 0.55}});
  EXPECT_NEAR(sums.direction(), 0.01 * sums.direction_weight(), 1e-9);
  EXPECT_NEAR(sums.direction_rad(1), 0.01, 1e-3);
  EXPECT_NEAR(sums.direction_rad(1 / sums.direction_weight()), 0.005, 1e-9);
  EXPECT_EQ(sums.direction_rad(0), 0);
}

TEST(LineSums, Moved_AreThoseOfPointsAboutTheOtherLine) {
  LineSums sums = sums_of({{1, 0.01}, {2, -0.02}, {4, 0.03}});
  sums.move(0.1, 0.02, 3);
  const LineSums other = sums_of({{1, 0.01 + 0.06}, {2, -0.02 + 0.08}, {4, 0.03 + 0.12}});
  EXPECT_NEAR(sums.distance, other.distance, 1e-12);
  EXPECT_NEAR(sums.distance_lever, other.distance_lever, 1e-12);
}

TEST(LineSums, NoPoint_HasNoDirection) {
  EXPECT_EQ(LineSums{}.direction_weight(), 0);
  EXPECT_EQ(LineSums{}.direction(), 0);
}

TEST(LineSums, DirectionVariance_IsThatOfTwoEnds) {
  EXPECT_NEAR(std::sqrt(direction_variance(2, 0.01)), std::sqrt(2.0) * 0.005, 1e-12);
}

}  // namespace
}  // namespace cornerd::core
