// SPDX-License-Identifier: MIT
#include "core/odometry/count_interpolator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

constexpr double kCount_m = 0.017;  // 12 counts a turn of a 65 mm wheel
constexpr double kSampled_s = 0.02;
constexpr double kFine_m = 0.00055;

/// Rolls, is read, and interpolates.
struct Wheel {
  CountInterpolator interpolator{kCount_m};
  double rolled_m = 0;
  double travel_m = 0;  ///< by the interpolator
  double counted_m = 0;
  double count_m = kCount_m;
  double sampled_s = kSampled_s;

  /// Metres that the interpolator says less than the wheel rolled, but for a constant.
  double behind_m() const { return rolled_m - travel_m; }
  void roll(double speed_m_s) {
    rolled_m += speed_m_s * sampled_s;
    const double counted_now_m = std::floor(rolled_m / count_m) * count_m;
    travel_m += interpolator.travel_m(counted_now_m - counted_m, sampled_s);
    counted_m = counted_now_m;
  }
};

TEST(CountInterpolator, SteadySpeed_ErrorStaysFarBelowACount) {
  Wheel wheel;
  for (int i = 0; i < 100; ++i) wheel.roll(0.3);
  double least = wheel.behind_m();
  double most = least;
  for (int i = 0; i < 100; ++i) {
    wheel.roll(0.3);
    least = std::min(least, wheel.behind_m());
    most = std::max(most, wheel.behind_m());
  }
  // The counts by themselves are behind by up to a whole one.
  EXPECT_LT(most - least, 0.25 * kCount_m);
}

TEST(CountInterpolator, AnySpeed_StaysWithinTheCount) {
  Wheel wheel;
  for (int i = 0; i < 1000; ++i) {
    wheel.roll(0.4 * std::sin(0.01 * i) * std::sin(0.13 * i));
    EXPECT_LE(std::abs(wheel.travel_m - wheel.counted_m), kCount_m / 2 + 1e-9);
  }
}

TEST(CountInterpolator, StopsAfterSpeed_ComesToRest) {
  Wheel wheel;
  for (int i = 0; i < 100; ++i) wheel.roll(0.3);
  for (int i = 0; i < 50; ++i) wheel.roll(0);
  const double before_m = wheel.travel_m;
  for (int i = 0; i < 50; ++i) wheel.roll(0);
  EXPECT_NEAR(wheel.travel_m, before_m, 0.05 * kCount_m);
}

TEST(CountInterpolator, ReadingsOfOneTime_NoTravelButTheCounts) {
  CountInterpolator interpolator(kCount_m);
  EXPECT_NEAR(interpolator.travel_m(0, 0), 0, 1e-12);
  EXPECT_NEAR(interpolator.travel_m(kCount_m, 0), 0.5 * kCount_m, 1e-9);
}

// 0.55 mm a count, read 5.7 times a second: where in its count the wheel is nobody knows.
TEST(CountInterpolator, FineCounts_ErrorIsNotThatOfTheEdge) {
  Wheel wheel{.interpolator = CountInterpolator(kFine_m), .count_m = kFine_m, .sampled_s = 0.176};
  double sum_m2 = 0;
  constexpr int kReadings = 1000;
  for (int i = 0; i < kReadings; ++i) {
    const double rolled_m = wheel.rolled_m;
    const double travel_m = wheel.travel_m;
    wheel.roll(0.2 + 0.1 * std::sin(0.7 * i));
    const double error_m = (wheel.travel_m - travel_m) - (wheel.rolled_m - rolled_m);
    sum_m2 += error_m * error_m;
  }
  // Of two ends, each uniform in its count.
  EXPECT_LT(std::sqrt(sum_m2 / kReadings), 1.05 * kFine_m * std::sqrt(2.0 / 12));
}

}  // namespace
}  // namespace cornerd::core
