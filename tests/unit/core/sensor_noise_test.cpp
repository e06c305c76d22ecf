// SPDX-License-Identifier: MIT
#include "core/sensor_noise.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace cornerd::core {
namespace {

constexpr std::array<SigmaTable::Point, 3> kPoints = {{{0.3, 0.002}, {1.0, 0.001}, {4.0, 0.01}}};

TEST(SensorNoise, WithoutTable_IsTheLargerOfFloorAndShare) {
  const SensorNoise noise{0.002, 0.01, 0};
  EXPECT_DOUBLE_EQ(noise.sigma_range_m(0.1), 0.002);
  EXPECT_DOUBLE_EQ(noise.sigma_range_m(3), 0.03);
}

TEST(SensorNoise, Table_ReplacesFloorAndShare) {
  const SensorNoise noise{0.5, 0.5, 0, SigmaTable(kPoints)};
  EXPECT_NEAR(noise.sigma_range_m(0.3), 0.002, 1e-9);
  EXPECT_NEAR(noise.sigma_range_m(1.0), 0.001, 1e-9);
  EXPECT_NEAR(noise.sigma_range_m(4.0), 0.01, 1e-9);
  EXPECT_NEAR(noise.variance_across_m2(1.0, 1), 1e-6, 1e-12);
}

TEST(SigmaTable, BetweenPoints_IsLinear) {
  const SigmaTable table(kPoints);
  EXPECT_NEAR(table.sigma_m(0.65), 0.0015, 1e-9);
  EXPECT_NEAR(table.sigma_m(2.51), 0.0055 + 0.01 * 0.003, 1e-8);
}

TEST(SigmaTable, BeyondEnds_FirstSigmaAndLastShare) {
  const SigmaTable table(kPoints);
  EXPECT_NEAR(table.sigma_m(0.05), 0.002, 1e-9);
  EXPECT_NEAR(table.sigma_m(-1), 0.002, 1e-9);
  for (const double range_m : {5.0, 12.79, 12.8, 40.0}) {
    EXPECT_NEAR(table.sigma_m(range_m), 0.0025 * range_m, 1e-7) << range_m;
  }
  EXPECT_EQ(table.sigma_m(std::numeric_limits<double>::infinity()),
            std::numeric_limits<double>::infinity());
}

TEST(SigmaTable, NoPoints_IsEmpty) {
  EXPECT_TRUE(SigmaTable().empty());
  EXPECT_TRUE(SigmaTable(std::span<const SigmaTable::Point>()).empty());
  EXPECT_FALSE(SigmaTable(kPoints).empty());
}

}  // namespace
}  // namespace cornerd::core
