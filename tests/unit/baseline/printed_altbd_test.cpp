// SPDX-License-Identifier: MIT
#include "baseline/printed_altbd.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../core/fixtures.hpp"

namespace cornerd::baseline {
namespace {

using namespace core;

SegmentTracks printed_walls(const PolarScan& points, const PrintedAltbdConfig& reading = {}) {
  SegmentTracks tracks;
  tracks.reserve(kMaxSegmentsPerScan);
  PrintedAltbd({}, {}, reading).track(points, tracks);
  return tracks;
}

PolarScan scan_in_room(const testing::ScanOptions& options) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(51);
  return testing::polar(source.take(*map, {1.5, 1, 0.3}, options));
}

testing::ScanOptions dense() {
  testing::ScanOptions options;
  options.samples = 800;
  return options;
}

TEST(PrintedAltbd, NoiselessScan_SquaredAxesFindWalls) {
  testing::ScanOptions exact;
  exact.with_noise = false;
  const SegmentTracks walls = printed_walls(
      scan_in_room(exact), {.axes = EllipseAxes::kSquared, .minor = MinorAxis::kShareOfRange});
  // The seam cuts one wall in two.
  EXPECT_GE(walls.size(), 4U);
  EXPECT_LE(walls.size(), 5U);
}

TEST(PrintedAltbd, NoiseAtA1Density_ThreePointLinesBreakWalls) {
  const PolarScan noisy = scan_in_room(dense());
  const PrintedAltbdConfig first_three{.axes = EllipseAxes::kSquared};
  EXPECT_GT(printed_walls(noisy, first_three).size(), 15U);  // of four
}

TEST(PrintedAltbd, EachVariant_StaysWithinCapacity) {
  const PolarScan noisy = scan_in_room(dense());
  for (const EllipseAxes axes : {EllipseAxes::kPrinted, EllipseAxes::kSquared}) {
    for (const MinorAxis minor : {MinorAxis::kMetres, MinorAxis::kShareOfRange}) {
      for (const TrackedLine line :
           {TrackedLine::kFirstThree, TrackedLine::kLastThree, TrackedLine::kAll}) {
        for (const ErrorMean mean : {ErrorMean::kLastThree, ErrorMean::kAll}) {
          for (const SegmentTrack& wall : printed_walls(noisy, {axes, minor, line, mean})) {
            EXPECT_GE(wall.support, DetectorConfig().min_support);
            EXPECT_LT(wall.last, noisy.size());
          }
        }
      }
    }
  }
}

TEST(PrintedAltbd, TooFewPoints_NoWall) {
  PolarScan points;
  points.begin(0.01);
  for (std::uint32_t i = 0; i + 1 < DetectorConfig().min_support; ++i) points.append(0.01 * i, 1);
  EXPECT_TRUE(printed_walls(points).empty());
  EXPECT_TRUE(printed_walls(testing::polar(Scan())).empty());
}

}  // namespace
}  // namespace cornerd::baseline
