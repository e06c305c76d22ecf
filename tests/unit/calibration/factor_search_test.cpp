// SPDX-License-Identifier: MIT
#include "calibration/factor_search.hpp"

#include <gtest/gtest.h>

#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

using calibration::HeadingSource;

/// A drive whose wheels measure 1 / `encoder` of each rotation, and whose gyro 1 / `gyro` of it.
KnownDrive scaled_drive(const core::DriveGeometry& geometry, double encoder, double gyro) {
  KnownDrive drive = known_drive(geometry, 1);
  for (core::OdometryIncrement& step : drive.steps) {
    const double left_m = step.left_m * (1 + kKnownErrors.left_scale);
    const double right_m = step.right_m * (1 + kKnownErrors.right_scale);
    const double half_m = (right_m - left_m) / 2 / (1 + kKnownErrors.track_scale) / encoder;
    const double translation_m = (left_m + right_m) / 2;
    step.left_m = translation_m - half_m;
    step.right_m = translation_m + half_m;
    step.gyro_rad -= kKnownErrors.gyro_bias_rad_s * step.duration_s();
    step.gyro_rad /= (1 + kKnownErrors.gyro_scale) * gyro;
  }
  return drive;
}

FoundFactors found(double encoder, double gyro, HeadingSource source) {
  const core::DriveGeometry geometry;
  const KnownDrive drive = scaled_drive(geometry, encoder, gyro);
  return search_factors(drive.steps, drive.places, geometry, {source, {}});
}

TEST(SearchFactors, SingleSensor_GivesItsFactor) {
  for (const double factor : {0.5, 0.791, 0.99, 1.02, 1.5, 2.2}) {
    const FoundFactors encoder = found(factor, 1, HeadingSource::kEncoder);
    EXPECT_NEAR(encoder.factors.encoder_factor, factor, 0.0015);
    EXPECT_EQ(encoder.factors.gyro_factor, 1);
    EXPECT_FALSE(encoder.at_edge());
    const FoundFactors gyro = found(1, factor, HeadingSource::kGyro);
    EXPECT_NEAR(gyro.factors.gyro_factor, factor, 0.0015);
    EXPECT_EQ(gyro.factors.encoder_factor, 1);
    EXPECT_FALSE(gyro.at_edge());
  }
}

TEST(SearchFactors, FactorBeyondRange_IsMarkedAtEdge) {
  const FoundFactors encoder = found(3, 1, HeadingSource::kEncoder);
  EXPECT_EQ(encoder.factors.encoder_factor, kMaxFactor);
  EXPECT_TRUE(encoder.encoder_at_edge);
  EXPECT_FALSE(encoder.gyro_at_edge);
  EXPECT_TRUE(found(1, 3, HeadingSource::kGyro).gyro_at_edge);
}

TEST(SearchFactors, BothSensors_GiveTheRotationTogether) {
  const FoundFactors both = found(1 / 0.99, 1 / 1.02, HeadingSource::kWeighted);
  const calibration::PaperFactors& factors = both.factors;
  EXPECT_NEAR((factors.encoder_factor * 0.99 + factors.gyro_factor * 1.02) / 2, 1, 0.002);
}

TEST(SearchFactors, UselessSensor_GetsFactorZero) {
  const core::DriveGeometry geometry;
  KnownDrive drive = scaled_drive(geometry, 1, 1);
  for (std::size_t i = 0; i < drive.steps.size(); ++i) {
    drive.steps[i].gyro_rad = i / 50 % 2 == 0 ? 0.03 : -0.02;
  }
  const FoundFactors both =
      search_factors(drive.steps, drive.places, geometry, {HeadingSource::kWeighted, {}});
  EXPECT_NEAR(both.factors.encoder_factor, 2, 0.01);
  EXPECT_NEAR(both.factors.gyro_factor, 0, 0.01);
  EXPECT_EQ(both.gyro_at_edge, both.factors.gyro_factor == 0);
}

TEST(SearchFactors, DeadBand_IsKept) {
  const core::DriveGeometry geometry;
  const KnownDrive drive = scaled_drive(geometry, 1, 1);
  const auto with_band = [&](double dead_band_rad) {
    return search_factors(drive.steps, drive.places, geometry,
                          {HeadingSource::kGyro, {1, 1, dead_band_rad}});
  };
  EXPECT_NEAR(with_band(0).factors.gyro_factor, 1, 0.0015);
  EXPECT_EQ(with_band(0.01).factors.dead_band_rad, 0.01);
  // No increment rotates by more than 0.02 rad: no factor in the range compensates that.
  const FoundFactors lost = with_band(0.2);
  EXPECT_GT(
      reckon(drive.steps, drive.places, geometry, {HeadingSource::kGyro, lost.factors}).mean_m, 1);
}

TEST(SearchFactors, NoKnownPoses_KeepsFactors) {
  const FoundFactors nothing = search_factors({}, {}, {}, {HeadingSource::kWeighted, {}});
  EXPECT_EQ(nothing.factors.encoder_factor, 1);
  EXPECT_EQ(nothing.factors.gyro_factor, 1);
}

}  // namespace
}  // namespace cornerd::calibration
