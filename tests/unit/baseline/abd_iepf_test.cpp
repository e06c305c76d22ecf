// SPDX-License-Identifier: MIT
#include "baseline/abd_iepf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../core/fixtures.hpp"

namespace cornerd::baseline {
namespace {

using namespace core;

constexpr AbdThreshold kThresholds[] = {AbdThreshold::kBorgesAldon, AbdThreshold::kWeerakoon};

SegmentTracks track(const PolarScan& points, const AbdIepfConfig& options = {}) {
  SegmentTracks tracks;
  tracks.reserve(kMaxSegmentsPerScan);
  EXPECT_EQ(AbdIepf({}, {}, options).track(points, tracks), 0U);
  return tracks;
}

PolarPoint at(double bearing_rad, double range_m) {
  const double c = std::cos(bearing_rad);
  const double s = std::sin(bearing_rad);
  return {bearing_rad, range_m, c, s, range_m * c, range_m * s};
}

Vec2 place_of(const PolarPoint& point) { return {point.x_m, point.y_m}; }

/// Farthest that a sample of the wall is from the chord between the wall's ends.
double height_m(const PolarScan& points, const SegmentTrack& wall) {
  const Vec2 begin = place_of(points[wall.first]);
  const Vec2 chord = place_of(points[wall.last]) - begin;
  double height = 0;
  for (std::uint32_t i = wall.first; i <= wall.last; ++i) {
    height = std::max(height, std::abs(cross(chord, place_of(points[i]) - begin)) / chord.norm());
  }
  return height;
}

/// Farthest that any sample is from the line of its own wall.
double worst_residual_m(const PolarScan& points, const SegmentTracks& tracks) {
  double worst = 0;
  for (const SegmentTrack& wall : tracks) {
    for (std::uint32_t i = wall.first; i <= wall.last; ++i) {
      const double distance = wall.line.normal.dot(place_of(points[i])) - wall.line.offset_m;
      worst = std::max(worst, std::abs(distance));
    }
  }
  return worst;
}

TEST(AbdThreshold, Formulas_MatchThePaper) {
  const double lambda = radians(8);
  for (const double step : {0.2, 0.7, 3.0, 7.5}) {
    for (const double bearing : {-3.1, -0.4, 0.0, 1.9}) {
      const PolarPoint before = at(bearing, 1.4);
      const PolarPoint after = at(bearing + radians(step), 0.9);
      const double ratio = std::sin(radians(step)) / std::sin(lambda - radians(step));
      EXPECT_NEAR(abd_threshold_m({.threshold = AbdThreshold::kBorgesAldon}, before, after),
                  1.4 * ratio + 3 * 0.0038, 1e-9);
      EXPECT_NEAR(abd_threshold_m({.threshold = AbdThreshold::kWeerakoon}, before, after),
                  0.9 * (1 - 3 * 0.0038) * ratio + 3 * 0.0038 * 1.4, 1e-9);
    }
  }
}

TEST(AbdThreshold, SamplesLambdaApart_AreNotNeighbours) {
  for (const AbdThreshold threshold : kThresholds) {
    for (const double step : {8.001, 45.0, 179.0, 181.0, 189.0, 359.0}) {
      EXPECT_EQ(abd_threshold_m({.threshold = threshold}, at(-kPi, 1), at(-kPi + radians(step), 1)),
                0);
    }
  }
}

TEST(AbdIepf, RectangularRoom_FourWallsPlusCuts) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(41);
  testing::ScanOptions exact;
  exact.with_noise = false;
  for (const AbdThreshold threshold : kThresholds) {
    for (int k = 0; k < 20; ++k) {
      const Pose2 T_map_lidar = source.place_in(0.7, 2.3, 0.7, 1.3);
      const SegmentTracks tracks =
          track(testing::polar(source.take(*map, T_map_lidar, exact)), {threshold});
      EXPECT_GE(tracks.size(), 4U);
      // The seam cuts one wall. The first chord is between its two sides, along that wall, and may
      // find any sample of the opposite one the farthest.
      EXPECT_LE(tracks.size(), 6U);
      // IEPF does not test splits against the noise: noise gives more pieces of the same walls.
      const PolarScan points = testing::polar(source.take(*map, T_map_lidar));
      const SegmentTracks pieces = track(points, {threshold});
      EXPECT_GE(pieces.size(), 4U);
      std::uint32_t support = 0;
      for (const SegmentTrack& piece : pieces) support += piece.support;
      EXPECT_GT(support, points.size() * 95 / 100);
    }
  }
}

TEST(AbdIepf, Walls_StayWithinSplitLimitOfTheirChords) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(42);
  testing::ScanOptions noisy;
  noisy.noise = {0.01, 0.02, radians(0.1)};
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.5, 2.2, 0.4, 1.5);
    const PolarScan points = testing::polar(source.take(*map, T_map_lidar, noisy));
    std::uint32_t free_from = 0;
    for (const SegmentTrack& wall : track(points)) {
      EXPECT_GE(wall.first, free_from);
      EXPECT_LT(wall.last, points.size());
      EXPECT_EQ(wall.last - wall.first + 1, wall.support);
      // After a split, the tested chord began one sample earlier.
      SegmentTrack judged = wall;
      if (wall.first > 0) --judged.first;
      const double limit_m = AbdIepfConfig().split_limit_m;
      EXPECT_LE(std::min(height_m(points, wall), height_m(points, judged)), limit_m + 1e-6);
      free_from = wall.last + 1;
    }
  }
}

TEST(AbdIepf, GapOfLambdaOrMore_EndsWall) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(43);
  testing::ScanOptions exact;
  exact.samples = 720;
  exact.with_noise = false;
  exact.first_bearing_rad = radians(179.9);
  const Scan whole = source.take(*map, {1.5, 1, kPi / 2}, exact);
  const auto walls_with_gap = [&](double gap_rad) {
    Scan scan;
    for (const Sample& sample : whole.samples()) {
      if (std::abs(sample.bearing_rad) > gap_rad / 2) scan.add(sample);
    }
    return track(testing::polar(scan)).size();
  };
  EXPECT_EQ(walls_with_gap(radians(9)), walls_with_gap(0) + 1);
  EXPECT_EQ(walls_with_gap(radians(6)), walls_with_gap(0));
}

TEST(AbdIepf, PrintedLimit_MissesCornersOfSmallRoom) {
  const auto map = testing::make_map(testing::rectangular_room(0.7, 0.5));
  testing::ScanSource source(44);
  for (int k = 0; k < 20; ++k) {
    const PolarScan points =
        testing::polar(source.take(*map, source.place_in(0.25, 0.45, 0.2, 0.3)));
    AbdIepfConfig printed;
    printed.split_limit_m = 0.46;  // the width of the arena's doors
    EXPECT_GT(worst_residual_m(points, track(points, printed)), 0.1);
    EXPECT_LT(worst_residual_m(points, track(points)), 0.05);
  }
}

TEST(AbdIepf, EndsCoincide_SplitsAtFarthestSample) {
  // The scan begins and ends in the middle of a wall. A chord through both ends would be along that
  // wall, with the whole opposite wall at one distance.
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(45);
  testing::ScanOptions exact;
  exact.with_noise = false;
  exact.samples = 720;
  exact.first_bearing_rad = kPi;
  Scan scan = source.take(*map, {1.5, 1, 0}, exact);
  Sample last = scan.samples().front();
  last.bearing_rad = -last.bearing_rad;
  scan.add(last);
  EXPECT_EQ(track(testing::polar(scan)).size(), 5U);
}

TEST(AbdIepf, FullScanOfNoise_StaysWithinCapacity) {
  // Each split is at a different sample.
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(46);
  testing::ScanOptions noise;
  noise.samples = static_cast<int>(kMaxSamplesPerScan);
  noise.noise = {0.3, 0.3, radians(0.1)};
  const PolarScan points = testing::polar(source.take(*map, {1.5, 1, 0}, noise));
  for (const AbdThreshold threshold : kThresholds) {
    SegmentTracks tracks;
    tracks.reserve(kMaxSegmentsPerScan);
    AbdIepf({}, {}, {.threshold = threshold, .split_limit_m = 1e-6}).track(points, tracks);
    EXPECT_LE(tracks.size(), kMaxSegmentsPerScan);
    for (const SegmentTrack& wall : tracks) EXPECT_LT(wall.last, points.size());
  }
}

}  // namespace
}  // namespace cornerd::baseline
