// SPDX-License-Identifier: MIT
#include "calibration/gross_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

using core::MotionStep;

/// A known drive, each step of which is told wrong.
GrossFaults faults_of(const std::function<void(MotionStep&)>& wrong, double scans = 1,
                      const core::DriveGeometry& geometry = {}) {
  KnownDrive known = known_drive({}, scans);
  for (MotionStep& step : known.steps) wrong(step);
  return find_gross_faults(cut_windows(known.steps, known.places), geometry);
}

TEST(GrossFaults, ARobotThatIsAFewPercentOff_HasNone) {
  EXPECT_FALSE(faults_of([](MotionStep&) {}).any());
  EXPECT_FALSE(faults_of([](MotionStep& step) { step.has_gyro = false; }).any());
  EXPECT_FALSE(faults_of([](MotionStep& step) { step.left_m *= 1.2; }).any());
  EXPECT_FALSE(faults_of([](MotionStep& step) { step.gyro_rad *= 0.8; }).any());
}

TEST(GrossFaults, SlipsAndJitter_AreNone) {
  int i = 0;
  const GrossFaults faults = faults_of([&](MotionStep& step) {
    if (++i % 200 == 0) step.left_m += 0.1;
    step.right_m += 0.002 * std::sin(i * 7.0);
    step.gyro_rad += 0.01 * std::cos(i * 11.0);
  });
  EXPECT_FALSE(faults.any());
}

TEST(GrossFaults, ADriveThatDoesNotTell_HasNone) {
  EXPECT_FALSE(faults_of([](MotionStep& step) { std::swap(step.left_m, step.right_m); }, 0).any())
      << "straight on";
  EXPECT_FALSE(find_gross_faults({}, {}).any());
  const KnownDrive known = known_drive({}, 1);
  const auto windows = cut_windows(known.steps, known.places);
  const std::span few = std::span(windows).first(9);
  EXPECT_FALSE(find_gross_faults(few, {}).any());
}

TEST(GrossFaults, WheelsExchangedOrReversed_AreNamed) {
  const GrossFaults exchanged =
      faults_of([](MotionStep& step) { std::swap(step.left_m, step.right_m); });
  EXPECT_TRUE(exchanged.are_exchanged);
  EXPECT_FALSE(exchanged.left_is_reversed || exchanged.right_is_reversed || exchanged.left_factor);
  const GrossFaults left = faults_of([](MotionStep& step) { step.left_m *= -1; });
  EXPECT_TRUE(left.left_is_reversed);
  EXPECT_FALSE(left.are_exchanged || left.right_is_reversed || left.left_factor);
  const GrossFaults both = faults_of([](MotionStep& step) {
    step.left_m *= -1;
    step.right_m *= -1;
  });
  EXPECT_TRUE(both.left_is_reversed && both.right_is_reversed);
  EXPECT_FALSE(both.are_exchanged || both.left_factor);
  const GrossFaults all = faults_of([](MotionStep& step) {
    std::swap(step.left_m, step.right_m);
    step.right_m *= -1;
  });
  EXPECT_TRUE(all.are_exchanged && all.right_is_reversed);
  EXPECT_FALSE(all.left_is_reversed || all.left_factor);
}

TEST(GrossFaults, AWrongCount_IsNamedWithItsFactor) {
  for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
    const GrossFaults faults = faults_of([&](MotionStep& step) {
      step.left_m /= factor;
      step.right_m /= factor;
    });
    ASSERT_TRUE(faults.left_factor && faults.right_factor) << factor;
    EXPECT_NEAR(*faults.left_factor / factor, 1.02, 0.01);
    EXPECT_EQ(*faults.left_factor, *faults.right_factor);
    EXPECT_FALSE(faults.track_m || faults.are_exchanged || faults.left_is_reversed);
  }
  const GrossFaults one = faults_of([](MotionStep& step) { step.right_m *= 4; });
  ASSERT_TRUE(one.left_factor && one.right_factor);
  EXPECT_NEAR(*one.left_factor, 1, 0.05);
  EXPECT_NEAR(*one.right_factor, 0.25, 0.02);
}

TEST(GrossFaults, AWrongTrack_IsNamedWithTheRightOne) {
  core::DriveGeometry wide;
  wide.track_m *= 2.5;
  const GrossFaults faults = faults_of([](MotionStep&) {}, 1, wide);
  ASSERT_TRUE(faults.track_m);
  EXPECT_NEAR(*faults.track_m, 0.16, 0.005);
  EXPECT_FALSE(faults.left_factor);
}

TEST(GrossFaults, AStandingWheel_IsNamedAndNothingElseOfTheWheels) {
  const GrossFaults faults = faults_of([](MotionStep& step) { step.left_m = 0; });
  EXPECT_TRUE(faults.left_stands);
  EXPECT_FALSE(faults.right_stands || faults.left_is_reversed || faults.left_factor);
}

TEST(GrossFaults, AMountOffToOneSide_IsNoFaultOfTheWheels) {
  KnownDrive known = known_drive({}, 1);
  for (KnownPlace& place : known.places) {
    place.T_map_base = place.T_map_base * core::Pose2{0, 0.2, 0};
  }
  EXPECT_FALSE(find_gross_faults(cut_windows(known.steps, known.places), {}).any());
}

TEST(GrossFaults, AWrongGyro_IsNamed) {
  const GrossFaults reversed = faults_of([](MotionStep& step) { step.gyro_rad *= -1; });
  EXPECT_TRUE(reversed.gyro_is_reversed);
  EXPECT_FALSE(reversed.gyro_factor || reversed.gyro_bias_rad_s || reversed.left_factor);
  const GrossFaults degrees = faults_of([](MotionStep& step) { step.gyro_rad *= 180 / core::kPi; });
  ASSERT_TRUE(degrees.gyro_factor);
  EXPECT_NEAR(*degrees.gyro_factor, 57.3 * 1.02, 0.3);
  const GrossFaults biased =
      faults_of([](MotionStep& step) { step.gyro_rad += 0.6 * step.duration_s(); });
  ASSERT_TRUE(biased.gyro_bias_rad_s);
  EXPECT_NEAR(*biased.gyro_bias_rad_s, 0.61, 0.01);
  int i = 0;
  const GrossFaults another =
      faults_of([&](MotionStep& step) { step.gyro_rad = 0.02 * std::sin(++i * 7.0); });
  EXPECT_TRUE(another.gyro_is_unrelated);
}

}  // namespace
}  // namespace cornerd::calibration
