// SPDX-License-Identifier: MIT
#include "calibration/bearing_bins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "calibration/robust_statistics.hpp"
#include "core/geometry/angle.hpp"
#include "static_room.hpp"

namespace cornerd::calibration {
namespace {

double median_sigma_m(const BearingBins& bins) {
  std::vector<double> sigmas;
  for (const BinSpread& spread : bins.spreads()) sigmas.push_back(spread.sigma_m);
  return median(sigmas);
}

TEST(BearingBins, GaussianRanges_GiveTheirSigma) {
  StaticRoom room;
  room.sigma_m = [](double) { return 0.004; };
  EXPECT_NEAR(median_sigma_m(room.record()), 0.004, 0.0003);
}

TEST(BearingBins, OutliersAndSlope_DoNotChangeSigma) {
  StaticRoom room;
  room.sigma_m = [](double) { return 0.004; };
  room.outliers = 0.1;
  const BearingBins bins = room.record();
  EXPECT_NEAR(median_sigma_m(bins), 0.004, 0.0004);
  std::vector<double> rejected;
  for (const BinSpread& spread : bins.spreads()) rejected.push_back(spread.rejected);
  EXPECT_NEAR(median(rejected), 0.1, 0.04);
}

TEST(BearingBins, ObliqueWall_GivesItsSlope) {
  StaticRoom room;
  room.sigma_m = [](double) { return 0.001; };
  for (const BinSpread& spread : room.record().spreads()) {
    // The wall 7 m ahead: range = 7 / cos, slope = range * tan.
    if (spread.bearing_rad < 0.02 || spread.bearing_rad > 0.3) continue;
    EXPECT_NEAR(spread.steepness(), std::tan(spread.bearing_rad), 0.03);
    EXPECT_NEAR(spread.range_m, 7 / std::cos(spread.bearing_rad), 0.003);
  }
}

TEST(BearingBins, FewScans_UseWiderBinsOrNone) {
  StaticRoom room;
  room.sigma_m = [](double) { return 0.002; };
  room.scans = 15;
  const std::size_t wide = room.record().spreads().size();
  EXPECT_GT(wide, 250u);
  EXPECT_LE(wide, 360u);
  room.scans = 5;
  const BearingBins five = room.record();
  EXPECT_GT(five.spreads().size(), 60u);
  EXPECT_NEAR(median_sigma_m(five), 0.002, 0.0004);
  room.scans = 2;
  EXPECT_TRUE(room.record().spreads().empty());
}

TEST(BearingBins, MovingLidar_HasDrift) {
  BearingBins still;
  BearingBins moving;
  for (int i = 0; i < 60 * 300; ++i) {
    const double bearing_rad = core::kTwoPi * i / 300.37;
    const double wobble_m = 0.001 * std::sin(12.9898 * i);
    still.add(bearing_rad, StaticRoom::true_range_m(bearing_rad) + wobble_m);
    moving.add(bearing_rad, StaticRoom::true_range_m(bearing_rad) + wobble_m + 2e-6 * i);
  }
  const auto median_drift = [](const BearingBins& bins) {
    std::vector<double> drifts;
    for (const BinSpread& spread : bins.spreads()) drifts.push_back(std::abs(spread.drift));
    return median(drifts);
  };
  EXPECT_LT(median_drift(still), 0.5);
  EXPECT_GT(median_drift(moving), 1.3);
}

TEST(BearingBins, EmptyAndInvalidSamples_AreIgnored) {
  BearingBins bins;
  bins.add(1, 0);
  bins.add(1, std::numeric_limits<double>::quiet_NaN());
  bins.add(std::numeric_limits<double>::quiet_NaN(), 1);
  EXPECT_EQ(bins.returns(), 0u);
  bins.add(core::kPi, 1);
  bins.add(-core::kPi, 1);
  bins.add(50, 1);
  EXPECT_EQ(bins.returns(), 3u);
  EXPECT_EQ(bins.all().size(), 3u);
  EXPECT_TRUE(bins.spreads().empty());
}

}  // namespace
}  // namespace cornerd::calibration
