// SPDX-License-Identifier: MIT
#include "core/odometry/cusum.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cornerd::core {
namespace {

TEST(Cusum, NoiseAlone_IsNoChange) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Cusum cusum;
  for (int i = 0; i < 5000; ++i) {
    cusum.add(normal(random));
    ASSERT_FALSE(cusum.is_change()) << i;
  }
}

TEST(Cusum, ShiftByTwoSigma_IsFoundWithinTenInnovations) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal(2);
  Cusum cusum;
  int needed = 0;
  while (!cusum.is_change() && needed < 100) {
    cusum.add(normal(random));
    ++needed;
  }
  EXPECT_LE(needed, 10);
}

}  // namespace
}  // namespace cornerd::core
