// SPDX-License-Identifier: MIT
// Drives whose odometry readings have late or early times.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "calibration/delay_search.hpp"
#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

/// Known poses at the rate of a lidar.
void blur(std::vector<KnownPose>& places, unsigned seed, double sigma = 0.001) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (KnownPose& place : places) {
    place.T_map_base.x_m += sigma * normal(random);
    place.T_map_base.y_m += sigma * normal(random);
    place.T_map_base.theta_rad += sigma * normal(random);
  }
}

KnownDrive late_drive(double late_s, unsigned seed, bool with_gyro = true) {
  KnownDrive known = known_drive({}, 1, with_gyro);
  known.steps = at_true_times(known.steps, -late_s);
  blur(known.places, seed);
  return known;
}

/// Two minutes with a yaw rate that changes too slowly to determine the delay.
KnownDrive slow_drive(double late_s, unsigned seed) {
  KnownDrive known = known_drive({}, 1);
  known.places.clear();
  known.steps.clear();
  core::Pose2 T_map_base;
  constexpr core::TimeNs kStep_ns = 20'000'000;
  for (int i = 0; i < 6000; ++i) {
    if (i % 7 == 0) known.places.push_back({i * kStep_ns, T_map_base});
    const double rotation_rad = 0.02 * 0.1 * std::sin(core::kTwoPi * i / 6000);
    const double way_m = 0.02 * 0.4;
    T_map_base = T_map_base * core::arc(way_m, rotation_rad);
    core::OdometryIncrement step{.from_ns = i * kStep_ns, .to_ns = (i + 1) * kStep_ns};
    step.left_m = way_m - rotation_rad * core::DriveGeometry{}.track_m / 2;
    step.right_m = way_m + rotation_rad * core::DriveGeometry{}.track_m / 2;
    step.gyro_rad = rotation_rad;
    step.has_gyro = true;
    known.steps.push_back(step);
  }
  known.steps = at_true_times(known.steps, -late_s);
  blur(known.places, seed, 0.002);
  return known;
}

class LateReadings : public testing::TestWithParam<double> {};

TEST_P(LateReadings, SearchAndFit_FindDelayAndParameters) {
  const double late_s = GetParam();
  for (const bool with_gyro : {true, false}) {
    const KnownDrive known = late_drive(late_s, 1, with_gyro);
    const DelaySearch search = search_delay(known.steps, known.places, 0);
    EXPECT_NEAR(search.delay_s, late_s, 0.01);
    EXPECT_EQ(search.is_unambiguous, late_s != 0);
    EXPECT_FALSE(search.at_edge);
    const auto fit = fit_odometry(known.steps, known.places, {}, search.delay_s);
    ASSERT_TRUE(fit);
    EXPECT_TRUE(fit->has_delay);
    EXPECT_NEAR(fit->learned.delay_s, late_s, 0.003);
    EXPECT_NEAR(fit->learned.left_scale, kKnownErrors.left_scale, 0.002);
    EXPECT_NEAR(fit->learned.right_scale, kKnownErrors.right_scale, 0.002);
    EXPECT_NEAR(fit->learned.track_scale, kKnownErrors.track_scale, 0.004);
    if (!with_gyro) continue;
    EXPECT_NEAR(fit->learned.gyro_scale, kKnownErrors.gyro_scale, 0.001);
    EXPECT_NEAR(fit->learned.gyro_bias_rad_s, kKnownErrors.gyro_bias_rad_s, 0.0005);
    EXPECT_LT(reckon(known.steps, known.places, {}, fit->learned).mean_m, 0.1);
  }
}
INSTANTIATE_TEST_SUITE_P(ByDelay, LateReadings,
                         testing::Values(-0.55, -0.3, -0.06, 0.0, 0.02, 0.17, 0.5));

TEST(DelaySearch, DelayBeyondRange_IsMarkedAtEdge) {
  for (const double late_s : {-0.75, 0.75}) {
    const KnownDrive known = late_drive(late_s, 1);
    const DelaySearch search = search_delay(known.steps, known.places, 0);
    EXPECT_TRUE(search.at_edge);
    EXPECT_GT(search.delay_s * late_s, 0);
  }
}

TEST(DelaySearch, LargeScaleErrors_DoNotChangeDelay) {
  KnownDrive known = late_drive(0.3, 1);
  for (core::OdometryIncrement& step : known.steps) {
    std::swap(step.left_m, step.right_m);
    step.left_m *= 4;
    step.gyro_rad *= -57.3;
  }
  EXPECT_NEAR(search_delay(known.steps, known.places, 0).delay_s, 0.3, 0.01);
}

TEST(DelaySearch, ConstantSpeed_KeepsConfiguredDelayWithLargeSigma) {
  for (const double late_s : {0.0, 0.1}) {
    const KnownDrive known = slow_drive(late_s, 3);
    const DelaySearch search = search_delay(known.steps, known.places, 0.015);
    EXPECT_FALSE(search.is_unambiguous);
    EXPECT_EQ(search.delay_s, 0.015);
    const auto fit = fit_odometry(known.steps, known.places, {}, search.delay_s);
    ASSERT_TRUE(fit);
    EXPECT_FALSE(fit->has_delay);
    EXPECT_EQ(fit->learned.delay_s, 0.015);
    EXPECT_GT(fit->sigma.delay_s, 0.025);
    EXPECT_NEAR(fit->learned.gyro_scale, 0, 0.03);
  }
}

TEST(DelaySearch, NoWindows_IsAmbiguous) {
  EXPECT_EQ(search_delay({}, {}, 0.05).delay_s, 0.05);
  EXPECT_FALSE(search_delay({}, {}, 0.05).is_unambiguous);
}

TEST(OdometryFit, Errors_MatchSigmas) {
  constexpr int kDrives = 20;
  double squares[6] = {};
  for (int seed = 1; seed <= kDrives; ++seed) {
    const KnownDrive known = late_drive(0.04, static_cast<unsigned>(seed));
    const auto fit = fit_odometry(known.steps, known.places, {}, 0.03);
    ASSERT_TRUE(fit);
    const auto add = [&](int i, double core::OdometryParameters::*value, double truth) {
      const double z = (fit->learned.*value - truth) / fit->sigma.*value;
      squares[i] += z * z / kDrives;
    };
    add(0, &core::OdometryParameters::gyro_bias_rad_s, kKnownErrors.gyro_bias_rad_s);
    add(1, &core::OdometryParameters::left_scale, kKnownErrors.left_scale);
    add(2, &core::OdometryParameters::right_scale, kKnownErrors.right_scale);
    add(3, &core::OdometryParameters::track_scale, kKnownErrors.track_scale);
    add(4, &core::OdometryParameters::gyro_scale, kKnownErrors.gyro_scale);
    add(5, &core::OdometryParameters::delay_s, 0.04);
  }
  // Bounds of a mean of twenty squared normal variables, one in thousands.
  for (const double square : squares) {
    EXPECT_GT(square, 0.05);
    EXPECT_LT(square, 2.4);
  }
}

}  // namespace
}  // namespace cornerd::calibration
