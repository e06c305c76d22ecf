// SPDX-License-Identifier: MIT
#include "replay/simulator/sensor_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace cornerd::replay {
namespace {

TEST(FieldOfView, FullCircle_ContainsEveryBearing) {
  for (const double centre_rad : {0.0, 0.3, core::kPi}) {
    const FieldOfView all{core::radians(360), centre_rad};
    for (int eighths = -100'000; eighths <= 100'000; ++eighths) {
      const double bearing_rad = core::radians(eighths / 8.0);
      ASSERT_TRUE(all.contains(bearing_rad));
      ASSERT_TRUE(FieldOfView().contains(centre_rad + bearing_rad));
    }
  }
}

TEST(SensorErrors, PerfectModel_ChangesNothingWithinTheLimits) {
  SensorErrors noise(SensorModel::perfect(), 1);
  EXPECT_EQ(noise.measured(1.25), 1.25);
  EXPECT_EQ(noise.measured(0.15), 0.15);
  EXPECT_EQ(noise.measured(0.149), 0);
  EXPECT_EQ(noise.measured(12.01), 0);
  EXPECT_EQ(noise.measured(0), 0);
  EXPECT_EQ(noise.direction_error(1), 0);
}

TEST(SensorErrors, MissingSamples_HaveShareAndRunLength) {
  for (const double run : {1.0, 10.0}) {
    SensorModel model = SensorModel::perfect();
    model.missing = 0.6;
    model.missing_run = run;
    SensorErrors noise(model, 3);
    int missing = 0;
    int changes = 0;
    bool last = false;
    constexpr int kCount = 200'000;
    for (int i = 0; i < kCount; ++i) {
      const bool now = noise.measured(1) == 0;
      missing += now;
      changes += now != last;
      last = now;
    }
    EXPECT_NEAR(static_cast<double>(missing) / kCount, 0.6, 0.01);
    EXPECT_NEAR(static_cast<double>(changes) / kCount, 2 * 0.6 * 0.4 / run, 0.01);
  }
}

TEST(SensorErrors, Outliers_HaveTheirShareWithinTheLimits) {
  SensorModel model = SensorModel::perfect();
  model.outliers = 0.1;
  SensorErrors noise(model, 5);
  int outliers = 0;
  int nearer = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double range_m = noise.measured(2);
    EXPECT_GE(range_m, 0.15);
    EXPECT_LE(range_m, 12);
    outliers += range_m != 2;
    nearer += range_m < 2;
  }
  EXPECT_NEAR(outliers / 1e5, 0.1, 0.005);
  EXPECT_GT(nearer, outliers / 2);
}

TEST(SensorErrors, RangeNoise_GrowsWithTheRangeBeyondTheFloor) {
  SensorModel model = SensorModel::perfect();
  model.noise.floor_m = 0.0015;
  model.noise.share = 0.005;
  for (const double range_m : {0.25, 4.0}) {
    SensorErrors noise(model, 11);
    double sum = 0;
    double sum_of_squares = 0;
    constexpr int kCount = 100'000;
    for (int i = 0; i < kCount; ++i) {
      const double error_m = noise.measured(range_m) - range_m;
      sum += error_m;
      sum_of_squares += error_m * error_m;
    }
    const double sigma_m = std::max(0.0015, 0.005 * range_m);
    EXPECT_NEAR(sum / kCount, 0, 0.02 * sigma_m);
    EXPECT_NEAR(std::sqrt(sum_of_squares / kCount), sigma_m, 0.02 * sigma_m);
  }
}

TEST(SensorErrors, RangeNoise_FollowsACalibratedTable) {
  const core::SigmaTable::Point points[] = {{0.5, 0.001}, {2, 0.007}};
  SensorModel model = SensorModel::perfect();
  model.noise.table = core::SigmaTable(points);
  for (const auto& [range_m, sigma_m] : {std::pair{0.5, 0.001}, {1.25, 0.004}, {4.0, 0.014}}) {
    SensorErrors noise(model, 11);
    double sum_of_squares = 0;
    constexpr int kCount = 100'000;
    for (int i = 0; i < kCount; ++i) {
      const double error_m = noise.measured(range_m) - range_m;
      sum_of_squares += error_m * error_m;
    }
    EXPECT_NEAR(std::sqrt(sum_of_squares / kCount), sigma_m, 0.02 * sigma_m) << range_m;
  }
}

TEST(SensorErrors, Biases_ChangeRangeAndDirection) {
  SensorModel model = SensorModel::perfect();
  model.range_scale = 1.01;
  model.range_offset_m = -0.02;
  model.eccentricity_rad = 0.01;
  model.eccentricity_phase_rad = 0.5;
  SensorErrors noise(model, 1);
  EXPECT_DOUBLE_EQ(noise.measured(3), 3.01);
  EXPECT_DOUBLE_EQ(noise.direction_error(0.5), 0);
  EXPECT_DOUBLE_EQ(noise.direction_error(0.5 + core::kPi / 2), 0.01);
}

TEST(SensorErrors, BeamOnAnEdge_GivesARangeBetweenItsSides) {
  SensorErrors noise(SensorModel::perfect(), 1);
  EXPECT_DOUBLE_EQ(noise.mixed(1.0, 1.01), 1.005);
  EXPECT_EQ(noise.mixed(0, 1.01), 1.01);
  for (int i = 0; i < 100; ++i) {
    const double range_m = noise.mixed(3, 1);
    EXPECT_GE(range_m, 1);
    EXPECT_LE(range_m, 3);
  }
}

}  // namespace
}  // namespace cornerd::replay
