// SPDX-License-Identifier: MIT
#include "calibration/odometry_fit.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "calibration/drive_reckoning.hpp"
#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

TEST(OdometryFit, NoiseFreeDrive_GivesItsParameters) {
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

TEST(OdometryFit, WithoutGyro_GivesWheelParameters) {
  const core::DriveGeometry geometry;
  const KnownDrive known = known_drive(geometry, 1, /*with_gyro=*/false);
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_FALSE(fit->has_gyro);
  EXPECT_NEAR(fit->learned.track_scale, kKnownErrors.track_scale, 5e-4);
}

TEST(OdometryFit, OccasionalSlips_AreDownweighted) {
  const core::DriveGeometry geometry;
  KnownDrive known = known_drive(geometry, 1);
  for (std::size_t i = 0; i < known.steps.size(); i += 400) known.steps[i].left_m += 0.03;
  const auto fit = fit_odometry(known.steps, known.places, geometry);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->learned.left_scale, kKnownErrors.left_scale, 0.004);
  EXPECT_NEAR(fit->learned.gyro_scale, kKnownErrors.gyro_scale, 1e-3);
}

TEST(OdometryFit, TooLittleMotion_GivesNullopt) {
  const core::DriveGeometry geometry;
  const KnownDrive straight = known_drive(geometry, 0);
  EXPECT_FALSE(fit_odometry(straight.steps, straight.places, geometry)) << "no turn, no track";
  const KnownDrive known = known_drive(geometry, 1);
  EXPECT_FALSE(fit_odometry({}, known.places, geometry));
  EXPECT_FALSE(fit_odometry(known.steps, {}, geometry));
  EXPECT_FALSE(
      fit_odometry(std::span(known.steps).first(200), std::span(known.places).first(20), geometry));
}

TEST(OdometryFit, Gaps_AreLeftOut) {
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

TEST(Reckon, DeadBand_AppliesToWholeIncrements) {
  // A known pose lies in the middle of an increment; half of it must not stay under the dead band.
  const core::DriveGeometry geometry;
  core::OdometryIncrement step;
  step.to_ns = 100'000'000;
  step.left_m = step.right_m = 1.5 * 0.01 * geometry.wheel_radius_m;
  const std::vector<KnownPose> places = {
      {0, {}}, {50'000'000, {step.left_m / 2, 0, 0}}, {100'000'000, {step.left_m, 0, 0}}};
  const calibration::DeadReckoningConfig with_dead_band{calibration::HeadingSource::kEncoder,
                                                        {1, 1, 0.01}};
  const DriveError error = reckon(std::vector{step}, places, geometry, with_dead_band);
  EXPECT_EQ(error.places, 1U);
  EXPECT_NEAR(error.end_m, 0, 1e-9);
}

TEST(Reckon, NoKnownPoses_GiveNoError) {
  EXPECT_EQ(reckon({}, {}, {}, core::OdometryParameters{}).places, 0U);
}

}  // namespace
}  // namespace cornerd::calibration
