// SPDX-License-Identifier: MIT
#include "calibration/odometry_fit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

TEST(OdometryFit, ExactDrive_IsGivenBack) {
  const core::DriveGeometry geometry;
  const KnownDrive known = known_drive(geometry, 1);
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->learned.left_scale, kKnownErrors.left_scale, 2e-4);
  EXPECT_NEAR(fit->learned.right_scale, kKnownErrors.right_scale, 2e-4);
  EXPECT_NEAR(fit->learned.track_scale, kKnownErrors.track_scale, 5e-4);
  EXPECT_NEAR(fit->learned.gyro_scale, kKnownErrors.gyro_scale, 2e-4);
  EXPECT_NEAR(fit->learned.gyro_bias_rad_s, kKnownErrors.gyro_bias_rad_s, 1e-4);
  EXPECT_LT(reckon(known.steps, known.places, geometry, fit->learned).end_m, 0.05);
  EXPECT_GT(reckon(known.steps, known.places, geometry, core::OdometryParameters{}).end_m, 0.3);
}

TEST(OdometryFit, WithoutAGyro_TellsTheWheels) {
  const core::DriveGeometry geometry;
  const KnownDrive known = known_drive(geometry, 1, /*with_gyro=*/false);
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->has_gyro);
  EXPECT_NEAR(fit->learned.track_scale, kKnownErrors.track_scale, 5e-4);
}

TEST(OdometryFit, SlipsNowAndThen_AreOutvoted) {
  const core::DriveGeometry geometry;
  KnownDrive known = known_drive(geometry, 1);
  for (std::size_t i = 0; i < known.steps.size(); i += 400) known.steps[i].left_m += 0.03;
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->learned.left_scale, kKnownErrors.left_scale, 0.004);
  EXPECT_NEAR(fit->learned.gyro_scale, kKnownErrors.gyro_scale, 1e-3);
}

TEST(OdometryFit, TooLittle_IsNoFit) {
  const core::DriveGeometry geometry;
  const KnownDrive straight = known_drive(geometry, 0);
  EXPECT_FALSE(fit_odometry(straight.steps, straight.places, geometry)) << "no turn, no track";
  const KnownDrive known = known_drive(geometry, 1);
  EXPECT_FALSE(fit_odometry({}, known.places, geometry));
  EXPECT_FALSE(fit_odometry(known.steps, {}, geometry));
  EXPECT_FALSE(
      fit_odometry(std::span(known.steps).first(200), std::span(known.places).first(20), geometry));
}

TEST(OdometryFit, Holes_AreLeftOut) {
  const core::DriveGeometry geometry;
  KnownDrive known = known_drive(geometry, 1);
  for (std::size_t i = 500; i < 510; ++i) {
    known.steps[i].is_gap = true;
    known.steps[i].left_m = known.steps[i].right_m = known.steps[i].gyro_rad = 0;
  }
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->learned.left_scale, kKnownErrors.left_scale, 2e-4);
}

TEST(Reckon, DeadBand_IsForWholeSteps) {
  // The robot is looked at in the middle of a step: half of it must not stay under the dead band.
  const core::DriveGeometry geometry;
  core::OdometryIncrement step;
  step.to_ns = 100'000'000;
  step.left_m = step.right_m = 1.5 * 0.01 * geometry.wheel_radius_m;
  const std::vector<KnownPose> places = {
      {0, {}}, {50'000'000, {step.left_m / 2, 0, 0}}, {100'000'000, {step.left_m, 0, 0}}};
  const core::DeadReckoningConfig with_dead_band{core::HeadingSource::kEncoder, {1, 1, 0.01}};
  const DriveError error = reckon(std::vector{step}, places, geometry, with_dead_band);
  EXPECT_EQ(error.places, 1U);
  EXPECT_NEAR(error.end_m, 0, 1e-9);
}

TEST(Reckon, NothingKnown_IsNoError) {
  EXPECT_EQ(reckon({}, {}, {}, core::OdometryParameters{}).places, 0U);
}

}  // namespace
}  // namespace cornerd::calibration
