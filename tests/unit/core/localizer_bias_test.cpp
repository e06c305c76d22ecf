// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "core/localizer.hpp"
#include "tests/unit/core/fixtures.hpp"

namespace cornerd::core {
namespace {

/// Of a robot that stands, after ten seconds.
EstimatedBias learned_from(const EstimatedBias& resumed, double* error_m) {
  const auto map = testing::make_map(testing::l_shaped_room());
  LocalizerConfig config;
  config.calibrate_online = true;
  Localizer localizer(map, config);
  localizer.resume(resumed);
  testing::ScanSource source;
  const Pose2 at{1.3, 0.9, 0.4};
  for (int k = 0; k < 80; ++k) {
    testing::ScanOptions options;
    options.start_ns = k * from_seconds(options.scan_s);
    const PoseEstimate& pose = localizer.step(source.take(*map, at, options)).pose;
    *error_m = has_pose(pose.state) ? (pose.T_map_base.translation() - at.translation()).norm() : 9;
  }
  return localizer.estimated_bias();
}

EstimatedBias stored(double range_scale) {
  EstimatedBias bias;
  bias.bias.range_scale = range_scale;
  bias.sigma = {1e-4, 1e-4, 1e-4, 1e-4};
  bias.scans = 1000;
  return bias;
}

TEST(LocalizerBias, StoredBiasOfAnotherMap_IsForgotten) {
  for (const double range_scale : {-0.03, -0.018, 0.018, 0.03}) {
    double error_m = 0;
    const EstimatedBias now = learned_from(stored(range_scale), &error_m);
    EXPECT_LT(std::abs(now.bias.range_scale), 0.005) << range_scale;
    EXPECT_LT(now.scans, 100U) << range_scale;
    EXPECT_LT(error_m, 0.005) << range_scale;
  }
}

TEST(LocalizerBias, StoredBiasOfThisLidar_IsKept) {
  double error_m = 0;
  EXPECT_GE(learned_from(stored(0), &error_m).scans, 1000U);
  EXPECT_LT(error_m, 0.005);
}

}  // namespace
}  // namespace cornerd::core
