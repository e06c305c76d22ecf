// SPDX-License-Identifier: MIT
#include "calibration/range_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.hpp"
#include "static_room.hpp"

namespace cornerd::calibration {
namespace {

TEST(RangeNoise, KnownFloorAndShare_AreFound) {
  for (const auto& [floor_m, share] : {std::pair{0.004, 0.005}, {0.006, 0.0025}, {0.008, 0.01}}) {
    StaticRoom room;
    room.scans = 100;
    room.sigma_m = [f = floor_m, s = share](double range_m) { return std::max(f, s * range_m); };
    const auto noise = fit_range_noise(room.record().spreads());
    ASSERT_TRUE(noise.has_value());
    EXPECT_NEAR(noise->plain.floor_m, floor_m, 0.15 * floor_m);
    EXPECT_NEAR(noise->plain.share, share, 0.1 * share);
    EXPECT_LT(noise->plain_residual, 0.08);
  }
}

TEST(RangeNoise, BearingNoise_IsSeparatedFromRangeNoise) {
  StaticRoom room;
  room.scans = 100;
  room.bearing_rad = core::radians(0.2);
  room.sigma_m = [](double range_m) { return std::max(0.0015, 0.002 * range_m); };
  const auto noise = fit_range_noise(room.record().spreads());
  ASSERT_TRUE(noise.has_value());
  EXPECT_TRUE(noise->bearing_measured);
  EXPECT_NEAR(noise->plain.bearing_rad, core::radians(0.2), core::radians(0.02));
  EXPECT_NEAR(noise->plain.floor_m, 0.0015, 0.0004);
  EXPECT_NEAR(noise->plain.share, 0.002, 0.0005);
}

TEST(RangeNoise, NoiseOfOtherShape_IsInTable) {
  StaticRoom room;
  room.scans = 100;
  const auto sigma_m = [](double range_m) { return range_m < 3 ? 0.004 : 0.0015; };
  room.sigma_m = sigma_m;
  const auto noise = fit_range_noise(room.record().spreads());
  ASSERT_TRUE(noise.has_value());
  EXPECT_GT(noise->plain_residual, 0.2);
  ASSERT_GE(noise->table().size(), 3u);
  for (const auto& point : noise->table()) {
    EXPECT_NEAR(point.sigma_m, sigma_m(point.range_m), 0.15 * sigma_m(point.range_m))
        << point.range_m;
  }
}

TEST(RangeNoise, RangesWithoutBins_AreLeftOut) {
  // The room has walls at right angles 0.4, 2, 5.6 and 7 m away, and none in between.
  StaticRoom room;
  const auto noise = fit_range_noise(room.record().spreads());  // no noise at all
  ASSERT_TRUE(noise.has_value());
  for (const RangeCell& cell : noise->cells) {
    EXPECT_GE(cell.bins, 12u);
    EXPECT_GT(cell.sigma_m, 0);
    EXPECT_FALSE(cell.from_m >= 0.6 && cell.to_m <= 1.5) << cell.from_m;
  }
  const core::SensorNoise tabled{0, 0, 0, core::SigmaTable(noise->table())};
  for (double range_m = 0.05; range_m < 30; range_m += 0.05) {
    EXPECT_GT(noise->plain.sigma_range_m(range_m), 0);
    EXPECT_GT(tabled.sigma_range_m(range_m), 0);
  }
}

TEST(RangeNoise, FarWallsOnly_KeepTheirSigmaNearby) {
  std::vector<BinSpread> bins;
  for (int i = 0; i < 40; ++i) bins.push_back({0, 3.0 + 0.05 * i, 0.01, 0, 50, 0, 0});
  const auto noise = fit_range_noise(bins);
  ASSERT_TRUE(noise.has_value());
  EXPECT_NEAR(noise->plain.sigma_range_m(0.3), 0.01, 0.001);
  EXPECT_NEAR(noise->plain.sigma_range_m(10), 0.01 * 10 / 4.5, 0.005);
  EXPECT_FALSE(noise->bearing_measured);
  EXPECT_EQ(noise->plain.bearing_rad, core::SensorNoise{}.bearing_rad);
}

TEST(RangeNoise, NoBins_GiveNullopt) {
  EXPECT_FALSE(fit_range_noise({}).has_value());
  const BinSpread one{0, 1, 0.002, 0, 20, 0, 0};
  EXPECT_FALSE(fit_range_noise({&one, 1}).has_value());
}

}  // namespace
}  // namespace cornerd::calibration
