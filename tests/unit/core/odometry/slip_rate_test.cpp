// SPDX-License-Identifier: MIT
#include "core/odometry/slip_rate.hpp"

#include <gtest/gtest.h>

namespace cornerd::core {
namespace {

TEST(SlipRate, NoSlips_VarianceFades) {
  SlipRate rate;
  const double before = rate.rad2_per_m();
  for (int i = 0; i < 1000; ++i) rate.add(1e-6, 1e-6, 0.1);
  EXPECT_LT(rate.rad2_per_m(), before / 5);
}

TEST(SlipRate, BeyondThreeSigma_IsSlip) {
  SlipRate rate;
  EXPECT_FALSE(rate.add(8e-6, 1e-6, 0.1));
  EXPECT_TRUE(rate.add(1e-5, 1e-6, 0.1));
}

TEST(SlipRate, SlipEveryTwoMetres_IsItsMeanSquare) {
  SlipRate rate;
  for (int i = 0; i < 2000; ++i) rate.add(i % 20 == 0 ? 0.04 : 1e-6, 1e-6, 0.1);
  EXPECT_NEAR(rate.rad2_per_m(), 0.02, 0.002);
}

}  // namespace
}  // namespace cornerd::core
