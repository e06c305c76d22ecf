// SPDX-License-Identifier: MIT
#include "core/estimate/bias_estimator.hpp"

#include <gtest/gtest.h>

#include "../fixtures.hpp"
#include "core/localizer.hpp"

namespace cornerd::core {
namespace {

/// The scan as a lidar with this bias measures it.
Scan biased(const Scan& scan, const SensorBias& bias) {
  Scan result;
  for (Sample sample : scan.samples()) {
    if (sample.range_m > 0) {
      sample.range_m =
          static_cast<float>((1 + bias.range_scale) * sample.range_m + bias.range_offset_m);
    }
    const double bearing_rad = sample.bearing_rad;
    sample.bearing_rad = static_cast<float>(
        normalize_angle(bearing_rad + bias.bearing_sine_rad * std::sin(bearing_rad) +
                        bias.bearing_cosine_rad * std::cos(bearing_rad)));
    result.add(sample);
  }
  return result;
}

void learn(BiasEstimator& estimator, const WallMap& map, const Pose2& T_map_lidar,
           const PolarScan& points) {
  const auto evidence = estimator.evidence(map, T_map_lidar, points.points(), 1);
  ASSERT_TRUE(evidence);
  estimator.update(*evidence);
}

constexpr SensorBias kBias{0.01, 0.005, radians(0.2), radians(-0.2)};

/// Mean position error at the last five of `places` places, ten scans at each.
double error_after_m(int places, Localizer& localizer, const WallMap& map) {
  testing::ScanSource source(61);
  testing::ScanOptions options;
  double error_m = 0;
  int fixes = 0;
  for (int place = 0; place < places; ++place) {
    const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
    localizer.relocalize();
    for (int k = 0; k < 10; ++k) {
      options.start_ns += from_seconds(0.137);
      const Scan scan = biased(source.take(map, T_map_lidar, options), kBias);
      const PoseEstimate& pose = localizer.step(scan).pose;
      const bool named = has_pose(pose.state);
      if (!named || place < places - 5) continue;
      error_m += (pose.T_map_base.translation() - T_map_lidar.translation()).norm();
      ++fixes;
    }
  }
  EXPECT_GE(fixes, 20);
  return error_m / fixes;
}

TEST(BiasEstimator, ScansAtKnownPoses_BiasIsEstimated) {
  const auto map = testing::make_map(testing::l_shaped_room());
  BiasEstimator estimator(12, {}, {});
  testing::ScanSource source(62);
  PolarScan points;
  for (int k = 0; k < 60; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
    points.assign(biased(source.take(*map, T_map_lidar), kBias), 0.1, 12, 0, {}, estimator.bias());
    learn(estimator, *map, T_map_lidar, points);
  }
  EXPECT_EQ(estimator.scans(), 60U);
  EXPECT_NEAR(estimator.bias().range_scale, kBias.range_scale, 0.0015);
  EXPECT_NEAR(estimator.bias().range_offset_m, kBias.range_offset_m, 0.0015);
  EXPECT_NEAR(estimator.bias().bearing_sine_rad, kBias.bearing_sine_rad, radians(0.03));
  EXPECT_NEAR(estimator.bias().bearing_cosine_rad, kBias.bearing_cosine_rad, radians(0.03));
}

TEST(BiasEstimator, UnbiasedSensor_EstimateStaysZero) {
  const auto map = testing::make_map(testing::l_shaped_room());
  BiasEstimator estimator(12, {}, {});
  testing::ScanSource source(63);
  PolarScan points;
  for (int k = 0; k < 60; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
    points.assign(source.take(*map, T_map_lidar), 0.1, 12, 0, {}, estimator.bias());
    learn(estimator, *map, T_map_lidar, points);
  }
  EXPECT_NEAR(estimator.bias().range_scale, 0, 0.001);
  EXPECT_NEAR(estimator.bias().range_offset_m, 0, 0.001);
  EXPECT_NEAR(estimator.bias().bearing_sine_rad, 0, radians(0.03));
  EXPECT_NEAR(estimator.bias().bearing_cosine_rad, 0, radians(0.03));
}

TEST(BiasEstimator, MotionWithinScans_IsNotTakenForBias) {
  const auto map = testing::make_map(testing::l_shaped_room());
  BiasEstimator estimator(12, {}, {});
  testing::ScanSource source(65);
  testing::ScanOptions starts;
  starts.motion = Twist2{0.04, 0, 0.05};
  PolarScan points;
  for (int k = 0; k < 60; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
    const Scan scan = source.take(*map, T_map_lidar, starts);
    const TimeNs middle_ns = scan.start_ns() + (scan.end_ns() - scan.start_ns()) / 2;
    points.assign(scan, 0.1, 12, middle_ns, {}, estimator.bias());
    learn(estimator, *map, T_map_lidar, points);
  }
  EXPECT_NEAR(estimator.bias().range_scale, 0, 0.001);
  EXPECT_NEAR(estimator.bias().range_offset_m, 0, 0.001);
  EXPECT_NEAR(estimator.bias().bearing_sine_rad, 0, radians(0.03));
  EXPECT_NEAR(estimator.bias().bearing_cosine_rad, 0, radians(0.03));
}

TEST(BiasEstimator, Resumed_ContinuesFromStoredEstimate) {
  const auto map = testing::make_map(testing::l_shaped_room());
  const EstimatedBias stored{
      .bias = kBias, .sigma = {0.001, 0.001, radians(0.02), radians(0.02)}, .scans = 400};
  BiasEstimator estimator(12, {}, {});
  estimator.resume(stored);
  EXPECT_EQ(estimator.scans(), 400U);
  EXPECT_EQ(estimator.bias().range_offset_m, kBias.range_offset_m);
  EXPECT_EQ(estimator.estimate().sigma.range_scale, 0.001);
  testing::ScanSource source(66);
  PolarScan points;
  for (int k = 0; k < 60; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
    points.assign(biased(source.take(*map, T_map_lidar), kBias), 0.1, 12, 0, {}, estimator.bias());
    learn(estimator, *map, T_map_lidar, points);
    EXPECT_NEAR(estimator.bias().range_scale, kBias.range_scale, 0.0015);
    EXPECT_NEAR(estimator.bias().range_offset_m, kBias.range_offset_m, 0.0015);
  }
  EXPECT_EQ(estimator.scans(), 460U);
  estimator.forget();
  EXPECT_TRUE(estimator.bias().is_none());
  estimator.resume({});
  EXPECT_EQ(estimator.scans(), 0U);
}

TEST(BiasEstimator, NoForgetting_AllScansCountEqually) {
  const auto map = testing::make_map(testing::l_shaped_room());
  BiasEstimator estimator(12, {}, {}, 0);
  testing::ScanSource source(68);
  PolarScan points;
  for (int k = 0; k < 800; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
    const SensorBias now{.range_scale = 0, .range_offset_m = k < 400 ? 0.004 : 0};
    points.assign(biased(source.take(*map, T_map_lidar), now), 0.1, 12, 0, {}, estimator.bias());
    learn(estimator, *map, T_map_lidar, points);
  }
  EXPECT_NEAR(estimator.bias().range_offset_m, 0.002, 0.0004);
}

TEST(BiasEstimator, BiasBeyondLimit_IsReported) {
  const auto map = testing::make_map(testing::l_shaped_room());
  const SensorBias known{.range_offset_m = 0.03};
  BiasEstimator estimator(12, {}, known);
  estimator.resume({.bias = known, .sigma = {0.001, 0.001, 0.001, 0.001}, .scans = 50});
  EXPECT_EQ(estimator.bias().range_offset_m, 0.03);
  EXPECT_FALSE(estimator.estimate().is_limited);
  SensorBias far = known;
  far.range_scale = 0.05;
  estimator.resume({.bias = far, .sigma = {0.001, 0.001, 0.001, 0.001}, .scans = 50});
  EXPECT_TRUE(estimator.estimate().is_limited);
  EXPECT_EQ(estimator.bias().range_scale, 0.03);
}

TEST(BiasEstimator, MoreScans_SigmaDecreases) {
  const auto map = testing::make_map(testing::l_shaped_room());
  BiasEstimator estimator(12, {}, {});
  testing::ScanSource source(67);
  PolarScan points;
  double before = 1;
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.4, 2.2, 0.4, 1.4);
    points.assign(source.take(*map, T_map_lidar), 0.1, 12, 0, {}, estimator.bias());
    learn(estimator, *map, T_map_lidar, points);
    EXPECT_LT(estimator.estimate().sigma.range_scale, before);
    before = estimator.estimate().sigma.range_scale;
  }
}

TEST(BiasEstimator, FewPoints_EstimateIsUnchanged) {
  const auto map = testing::make_map(testing::l_shaped_room());
  BiasEstimator estimator(12, {}, {});
  testing::ScanSource source(64);
  testing::ScanOptions sparse;
  sparse.samples = 30;
  const PolarScan points = testing::polar(source.take(*map, {1, 1, 0}, sparse));
  EXPECT_FALSE(estimator.evidence(*map, {1, 1, 0}, points.points(), 1));
  EXPECT_EQ(estimator.scans(), 0U);
  EXPECT_TRUE(estimator.bias().is_none());
}

TEST(Localizer, BiasedLidar_BiasIsEstimatedOnline) {
  const auto map = testing::make_map(testing::l_shaped_room());
  Localizer learning(map, {});
  LocalizerConfig config;
  config.calibrate_online = false;
  Localizer trusting(map, config);
  const double with_m = error_after_m(14, learning, *map);
  const double without_m = error_after_m(14, trusting, *map);
  EXPECT_LT(with_m, 0.0025);
  EXPECT_GT(without_m, 0.004);
  EXPECT_NEAR(learning.estimated_bias().bias.range_scale, kBias.range_scale, 0.004);
  EXPECT_TRUE(trusting.estimated_bias().bias.is_none());
  learning.forget();
  EXPECT_TRUE(learning.estimated_bias().bias.is_none());
}

TEST(Localizer, ConfiguredBias_IsRemovedFromFirstScan) {
  const auto map = testing::make_map(testing::l_shaped_room());
  LocalizerConfig config;
  config.bias = kBias;
  config.calibrate_online = false;
  Localizer localizer(map, config);
  EXPECT_LT(error_after_m(5, localizer, *map), 0.001);
}

}  // namespace
}  // namespace cornerd::core
