// SPDX-License-Identifier: MIT
#include "calibration/wiring_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

using core::OdometryIncrement;

/// The faults of a known drive whose increments are changed by `wrong`.
WiringFaults faults_of(const std::function<void(OdometryIncrement&)>& wrong, double rotations = 1,
                       const core::DriveGeometry& geometry = {}) {
  KnownDrive known = known_drive({}, rotations);
  for (OdometryIncrement& step : known.steps) wrong(step);
  return find_wiring_faults(cut_windows(known.steps, known.places), geometry);
}

TEST(WiringFaults, ScaleErrorsOfFewPercent_AreNone) {
  EXPECT_FALSE(faults_of([](OdometryIncrement&) {}).any());
  EXPECT_FALSE(faults_of([](OdometryIncrement& step) { step.has_gyro = false; }).any());
  EXPECT_FALSE(faults_of([](OdometryIncrement& step) { step.left_m *= 1.2; }).any());
  EXPECT_FALSE(faults_of([](OdometryIncrement& step) { step.gyro_rad *= 0.8; }).any());
}

TEST(WiringFaults, SlipsAndJitter_AreNone) {
  int i = 0;
  const WiringFaults faults = faults_of([&](OdometryIncrement& step) {
    if (++i % 200 == 0) step.left_m += 0.1;
    step.right_m += 0.002 * std::sin(i * 7.0);
    step.gyro_rad += 0.01 * std::cos(i * 11.0);
  });
  EXPECT_FALSE(faults.any());
}

TEST(WiringFaults, TooLittleMotion_HasNone) {
  EXPECT_FALSE(
      faults_of([](OdometryIncrement& step) { std::swap(step.left_m, step.right_m); }, 0).any())
      << "straight on";
  EXPECT_FALSE(find_wiring_faults({}, {}).any());
  const KnownDrive known = known_drive({}, 1);
  const auto windows = cut_windows(known.steps, known.places);
  const std::span few = std::span(windows).first(9);
  EXPECT_FALSE(find_wiring_faults(few, {}).any());
}

TEST(WiringFaults, WheelsSwappedOrReversed_AreFound) {
  const WiringFaults exchanged =
      faults_of([](OdometryIncrement& step) { std::swap(step.left_m, step.right_m); });
  EXPECT_TRUE(exchanged.are_swapped);
  EXPECT_FALSE(exchanged.left_is_reversed || exchanged.right_is_reversed || exchanged.left_factor);
  const WiringFaults left = faults_of([](OdometryIncrement& step) { step.left_m *= -1; });
  EXPECT_TRUE(left.left_is_reversed);
  EXPECT_FALSE(left.are_swapped || left.right_is_reversed || left.left_factor);
  const WiringFaults both = faults_of([](OdometryIncrement& step) {
    step.left_m *= -1;
    step.right_m *= -1;
  });
  EXPECT_TRUE(both.left_is_reversed && both.right_is_reversed);
  EXPECT_FALSE(both.are_swapped || both.left_factor);
  const WiringFaults all = faults_of([](OdometryIncrement& step) {
    std::swap(step.left_m, step.right_m);
    step.right_m *= -1;
  });
  EXPECT_TRUE(all.are_swapped && all.right_is_reversed);
  EXPECT_FALSE(all.left_is_reversed || all.left_factor);
}

TEST(WiringFaults, WrongCountsPerTurn_GivesFactor) {
  for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
    const WiringFaults faults = faults_of([&](OdometryIncrement& step) {
      step.left_m /= factor;
      step.right_m /= factor;
    });
    ASSERT_TRUE(faults.left_factor && faults.right_factor) << factor;
    EXPECT_NEAR(*faults.left_factor / factor, 1.02, 0.01);
    EXPECT_EQ(*faults.left_factor, *faults.right_factor);
    EXPECT_FALSE(faults.track_m || faults.are_swapped || faults.left_is_reversed);
  }
  const WiringFaults one = faults_of([](OdometryIncrement& step) { step.right_m *= 4; });
  ASSERT_TRUE(one.left_factor && one.right_factor);
  EXPECT_NEAR(*one.left_factor, 1, 0.05);
  EXPECT_NEAR(*one.right_factor, 0.25, 0.02);
}

TEST(WiringFaults, WrongTrack_GivesTrueTrack) {
  core::DriveGeometry wide;
  wide.track_m *= 2.5;
  const WiringFaults faults = faults_of([](OdometryIncrement&) {}, 1, wide);
  ASSERT_TRUE(faults.track_m);
  EXPECT_NEAR(*faults.track_m, 0.16, 0.005);
  EXPECT_FALSE(faults.left_factor);
}

TEST(WiringFaults, StuckCounter_IsTheOnlyWheelFault) {
  const WiringFaults faults = faults_of([](OdometryIncrement& step) { step.left_m = 0; });
  EXPECT_TRUE(faults.left_is_stuck);
  EXPECT_FALSE(faults.right_is_stuck || faults.left_is_reversed || faults.left_factor);
}

TEST(WiringFaults, LidarMountOffToOneSide_IsNoWheelFault) {
  KnownDrive known = known_drive({}, 1);
  for (KnownPose& place : known.places) {
    place.T_map_base = place.T_map_base * core::Pose2{0, 0.2, 0};
  }
  EXPECT_FALSE(find_wiring_faults(cut_windows(known.steps, known.places), {}).any());
}

TEST(WiringFaults, WrongGyro_IsFound) {
  const WiringFaults reversed = faults_of([](OdometryIncrement& step) { step.gyro_rad *= -1; });
  EXPECT_TRUE(reversed.gyro_is_reversed);
  EXPECT_FALSE(reversed.gyro_factor || reversed.gyro_bias_rad_s || reversed.left_factor);
  const WiringFaults degrees =
      faults_of([](OdometryIncrement& step) { step.gyro_rad *= 180 / core::kPi; });
  ASSERT_TRUE(degrees.gyro_factor);
  EXPECT_NEAR(*degrees.gyro_factor, 57.3 * 1.02, 0.3);
  const WiringFaults biased =
      faults_of([](OdometryIncrement& step) { step.gyro_rad += 0.6 * step.duration_s(); });
  ASSERT_TRUE(biased.gyro_bias_rad_s);
  EXPECT_NEAR(*biased.gyro_bias_rad_s, 0.61, 0.01);
  int i = 0;
  const WiringFaults another =
      faults_of([&](OdometryIncrement& step) { step.gyro_rad = 0.02 * std::sin(++i * 7.0); });
  EXPECT_TRUE(another.gyro_is_unrelated);
}

}  // namespace
}  // namespace cornerd::calibration
