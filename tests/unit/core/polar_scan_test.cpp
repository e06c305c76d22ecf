// SPDX-License-Identifier: MIT
#include "core/polar_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fixtures.hpp"

namespace cornerd::core {
namespace {

bool is_sorted(const PolarScan& points) {
  return std::is_sorted(
      points.points().begin(), points.points().end(),
      [](const PolarPoint& a, const PolarPoint& b) { return a.bearing_rad < b.bearing_rad; });
}

Scan scan_of(std::initializer_list<double> bearings_rad) {
  Scan scan;
  for (const double bearing : bearings_rad) {
    Sample sample;
    sample.bearing_rad = static_cast<float>(bearing);
    sample.range_m = 1;
    scan.add(sample);
  }
  return scan;
}

TEST(PolarScan, TakeFew_AllAround) {
  const std::vector<PolarPoint> points(1000);
  std::vector<PolarPoint> few;
  EXPECT_EQ(take_few(points, 300, few), 3U);
  EXPECT_EQ(few.size(), 334U);
  EXPECT_EQ(take_few(points, 1001, few), 1U);
  EXPECT_EQ(few.size(), 1000U);
}

TEST(PolarScan, ClockwiseScanWithBackwardSteps_IsSorted) {
  const PolarScan points =
      testing::polar(scan_of({1, 0.9, 0.95, 0.5, -1, -0.9, -3, 3, 2, 2.1, 1.2}));
  EXPECT_EQ(points.size(), 11U);
  EXPECT_TRUE(is_sorted(points));
}

TEST(PolarScan, AnyOrder_IsSorted) {
  std::mt19937 random(5);
  Scan scan;
  for (std::size_t i = 0; i < kMaxSamplesPerScan; ++i) {
    Sample sample;
    sample.bearing_rad = static_cast<float>(static_cast<double>(random()) / 4294967296.0 * 6 - 3);
    sample.range_m = 1;
    scan.add(sample);
  }
  const PolarScan points = testing::polar(scan);
  EXPECT_EQ(points.size(), kMaxSamplesPerScan);
  EXPECT_TRUE(is_sorted(points));
}

/// Returns at all bearings between the two.
void append(PolarScan& points, double from_rad, double to_rad) {
  for (double bearing_rad = from_rad; bearing_rad <= to_rad; bearing_rad += points.spacing_rad()) {
    points.append(bearing_rad, 1);
  }
}

TEST(PolarScan, LargestGap_AcrossSeam_IsFound) {
  PolarScan points;
  EXPECT_EQ(points.largest_gap_rad(), kTwoPi);
  points.begin(0.01);
  points.append(-1, 1);
  EXPECT_EQ(points.largest_gap_rad(), kTwoPi);
  append(points, 0.5, 1.0001);
  EXPECT_NEAR(points.largest_gap_rad(), kTwoPi - 0.5, 1e-9);
  append(points, 2.5, 3.1001);
  EXPECT_NEAR(points.largest_gap_rad(), kTwoPi - 2.6, 1e-9);
}

TEST(PolarScan, IsolatedReturns_DoNotFillGap) {
  PolarScan points;
  points.begin(0.01);
  for (const double bearing_rad : {-3.0, -2.0, -1.99, -1.0}) points.append(bearing_rad, 1);
  append(points, 0, 3.0001);
  EXPECT_NEAR(points.largest_gap_rad(), kTwoPi - 3, 1e-9);
}

TEST(PolarScan, SparseReturns_LeaveNoGap) {
  PolarScan points;
  points.begin(0.01);
  for (int i = 0; i < 200; ++i) points.append(-kPi + i * kTwoPi / 200, 1);
  EXPECT_LT(points.largest_gap_rad(), 0.1);
}

TEST(PolarScan, ReturnsOutsideLimits_AreDropped) {
  Scan scan;
  for (const float range : {0.0F, 0.1F, 0.2F, 5.0F, 13.0F}) {
    Sample sample;
    sample.range_m = range;
    scan.add(sample);
  }
  PolarScan points;
  points.assign(scan, 0.15, 12);
  EXPECT_EQ(points.size(), 2U);
  points.assign(Scan(), 0.15, 12);
  EXPECT_EQ(points.size(), 0U);
}

TEST(PolarScan, ScanTakenInMotion_IsDeskewed) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  const Pose2 T_map_lidar{1.3, 0.8, 0.4};
  testing::ScanSource source;
  testing::ScanOptions options;
  options.with_noise = false;
  options.motion = Twist2{0.4, -0.2, 0.8};
  const Scan scan = source.take(*map, T_map_lidar, options);
  PolarScan points;
  points.assign(scan, 0.15, 12, from_seconds(options.scan_s / 2), options.motion);
  ASSERT_TRUE(is_sorted(points));
  for (const PolarPoint& point : points.points()) {
    const Vec2 place = T_map_lidar * Vec2(point.x_m, point.y_m);
    const double to_wall = std::min({std::abs(place.x()), std::abs(place.x() - 3),
                                     std::abs(place.y()), std::abs(place.y() - 2)});
    EXPECT_LT(to_wall, 1e-6);
  }
}

}  // namespace
}  // namespace cornerd::core
