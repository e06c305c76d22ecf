// SPDX-License-Identifier: MIT
#include "calibration/odometry_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/angle.hpp"

namespace cornerd::calibration {
namespace {

using core::HeadingSource;

const core::LearnedOdometry kTruth{0.01, 0.015, 0.025, -0.01, 0.02};

struct TestDrive {
  std::vector<core::MotionStep> steps;
  std::vector<KnownPlace> places;
};

/// Straights and turns for a minute at 50 steps a second, known every 0.14 s; `turns`: 0 for none.
TestDrive drive(const core::DriveGeometry& geometry, double turns, bool with_gyro = true) {
  TestDrive drive;
  core::Pose2 T_map_base{1, 2, 0.5};
  for (int i = 0; i < 3000; ++i) {
    if (i % 7 == 0) drive.places.push_back({i * core::TimeNs{20'000'000}, T_map_base});
    const double rate_rad_s = turns * (i / 100 % 3 == 0 ? 0.0 : i / 100 % 3 == 1 ? 0.9 : -0.7);
    const double way_m = 0.4 * 0.02;
    const double turn_rad = rate_rad_s * 0.02;
    T_map_base = T_map_base * core::arc(way_m, turn_rad);
    const double half_m = turn_rad * geometry.track_m * (1 + kTruth.track_scale) / 2;
    core::MotionStep step;
    step.from_ns = i * core::TimeNs{20'000'000};
    step.to_ns = step.from_ns + 20'000'000;
    step.left_m = (way_m - half_m) / (1 + kTruth.left_scale);
    step.right_m = (way_m + half_m) / (1 + kTruth.right_scale);
    step.gyro_rad = turn_rad * (1 + kTruth.gyro_scale) + kTruth.gyro_bias_rad_s * 0.02;
    step.has_gyro = with_gyro;
    drive.steps.push_back(step);
  }
  return drive;
}

TEST(OdometryFit, ExactDrive_IsGivenBack) {
  const core::DriveGeometry geometry;
  const TestDrive known = drive(geometry, 1);
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->learned.left_scale, kTruth.left_scale, 2e-4);
  EXPECT_NEAR(fit->learned.right_scale, kTruth.right_scale, 2e-4);
  EXPECT_NEAR(fit->learned.track_scale, kTruth.track_scale, 5e-4);
  EXPECT_NEAR(fit->learned.gyro_scale, kTruth.gyro_scale, 2e-4);
  EXPECT_NEAR(fit->learned.gyro_bias_rad_s, kTruth.gyro_bias_rad_s, 1e-4);
  EXPECT_LT(reckon(known.steps, known.places, geometry, fit->learned).end_m, 0.05);
  EXPECT_GT(reckon(known.steps, known.places, geometry, core::LearnedOdometry{}).end_m, 0.3);
}

TEST(OdometryFit, WithoutAGyro_TellsTheWheels) {
  const core::DriveGeometry geometry;
  const TestDrive known = drive(geometry, 1, /*with_gyro=*/false);
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->has_gyro);
  EXPECT_NEAR(fit->learned.track_scale, kTruth.track_scale, 5e-4);
}

TEST(OdometryFit, SlipsNowAndThen_AreOutvoted) {
  const core::DriveGeometry geometry;
  TestDrive known = drive(geometry, 1);
  for (std::size_t i = 0; i < known.steps.size(); i += 400) known.steps[i].left_m += 0.03;
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->learned.left_scale, kTruth.left_scale, 0.004);
  EXPECT_NEAR(fit->learned.gyro_scale, kTruth.gyro_scale, 1e-3);
}

TEST(OdometryFit, TooLittle_IsNoFit) {
  const core::DriveGeometry geometry;
  const TestDrive straight = drive(geometry, 0);
  EXPECT_FALSE(fit_odometry(straight.steps, straight.places, geometry)) << "no turn, no track";
  const TestDrive known = drive(geometry, 1);
  EXPECT_FALSE(fit_odometry({}, known.places, geometry));
  EXPECT_FALSE(fit_odometry(known.steps, {}, geometry));
  EXPECT_FALSE(
      fit_odometry(std::span(known.steps).first(200), std::span(known.places).first(20), geometry));
}

TEST(OdometryFit, Holes_AreLeftOut) {
  const core::DriveGeometry geometry;
  TestDrive known = drive(geometry, 1);
  for (std::size_t i = 500; i < 510; ++i) {
    known.steps[i].is_hole = true;
    known.steps[i].left_m = known.steps[i].right_m = known.steps[i].gyro_rad = 0;
  }
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->learned.left_scale, kTruth.left_scale, 2e-4);
}

TEST(SearchFactors, OneWrongFactor_IsFound) {
  const core::DriveGeometry geometry;
  TestDrive known = drive(geometry, 1);
  for (core::MotionStep& step : known.steps) {
    step.left_m *= 1 + kTruth.left_scale;  // wheels of equal size, the track is off by 1 %
    step.right_m *= 1 + kTruth.right_scale;
    step.gyro_rad -= kTruth.gyro_bias_rad_s * 0.02;
  }
  const auto found = [&](HeadingSource source) {
    return search_factors(known.steps, known.places, geometry, {source, {}});
  };
  EXPECT_NEAR(found(HeadingSource::kEncoder).encoder_factor, 1 / 0.99, 0.002);
  EXPECT_NEAR(found(HeadingSource::kGyro).gyro_factor, 1 / 1.02, 0.002);
  const core::PaperFactors both = found(HeadingSource::kWeighted);
  EXPECT_NEAR((both.encoder_factor * 0.99 + both.gyro_factor * 1.02) / 2, 1, 0.002);
}

TEST(Reckon, NothingKnown_IsNoError) {
  EXPECT_EQ(reckon({}, {}, {}, core::LearnedOdometry{}).places, 0U);
}

}  // namespace
}  // namespace cornerd::calibration
