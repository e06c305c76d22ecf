// SPDX-License-Identifier: MIT
#include "core/breakpoint/breakpoint_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../fixtures.hpp"
#include "core/breakpoint/detector.hpp"

namespace cornerd::core {
namespace {

void expect_same(const std::vector<Breakpoint>& one, const std::vector<Breakpoint>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].position, other[i].position);
    EXPECT_EQ(one[i].covariance, other[i].covariance);
    EXPECT_EQ(one[i].kind, other[i].kind);
    EXPECT_EQ(one[i].convex, other[i].convex);
    EXPECT_EQ(one[i].wall_on_right, other[i].wall_on_right);
    EXPECT_EQ(one[i].wall_on_left, other[i].wall_on_left);
    EXPECT_EQ(one[i].right_wall_rad, other[i].right_wall_rad);
    EXPECT_EQ(one[i].left_wall_rad, other[i].left_wall_rad);
    EXPECT_EQ(one[i].opening_rad, other[i].opening_rad);
    EXPECT_EQ(one[i].right_support, other[i].right_support);
    EXPECT_EQ(one[i].left_support, other[i].left_support);
  }
}

void append(std::vector<Breakpoint>& all, std::span<const Breakpoint> some) {
  all.insert(all.end(), some.begin(), some.end());
}

PolarScan noisy_scan(testing::ScanSource& source, const WallMap& map, const Pose2& T_map_lidar) {
  testing::ScanOptions options;
  options.missing_share = 0.3;
  return testing::polar(source.take(map, T_map_lidar, options));
}

TEST(BreakpointStream, ReturnByReturn_EqualsWholeScan) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(41);
  Detector detector({}, {});
  BreakpointStream stream({}, {});
  for (int k = 0; k < 40; ++k) {
    // Rays computed one by one, as the stream does: a scan's rays are rotated from one another.
    PolarScan scan;
    const PolarScan taken = noisy_scan(source, *map, source.place_in(0.3, 3.7, 0.3, 1.5));
    scan.begin(taken.spacing_rad());
    for (const PolarPoint& point : taken.points()) scan.append(point.bearing_rad, point.range_m);
    Detection whole;
    detector.detect(scan, whole);

    std::vector<Breakpoint> streamed;
    stream.begin(scan.spacing_rad(), Sweep::kCounterClockwise);
    for (const PolarPoint& point : scan.points()) {
      append(streamed, stream.add(point.bearing_rad, point.range_m));
    }
    append(streamed, stream.finish());
    expect_same(streamed, whole.breakpoints);
    EXPECT_EQ(stream.detection().segments.size(), whole.segments.size());
    EXPECT_EQ(stream.detection().noise_scale, whole.noise_scale);
  }
}

TEST(BreakpointStream, ClockwiseScan_EqualsMirroredScan) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(42);
  Detector detector({}, {});
  BreakpointStream stream({}, {});
  for (int k = 0; k < 10; ++k) {
    const PolarScan scan = noisy_scan(source, *map, source.place_in(0.3, 3.7, 0.3, 1.5));
    PolarScan mirror;
    mirror.begin(scan.spacing_rad());
    const std::vector<PolarPoint> clockwise(scan.points().rbegin(), scan.points().rend());
    for (const PolarPoint& point : clockwise) mirror.append(-point.bearing_rad, point.range_m);
    Detection expected;
    detector.detect(mirror, expected);
    for (Breakpoint& breakpoint : expected.breakpoints) breakpoint = mirrored(breakpoint);

    std::vector<Breakpoint> streamed;
    stream.begin(scan.spacing_rad(), Sweep::kClockwise);
    for (const PolarPoint& point : clockwise) {
      append(streamed, stream.add(point.bearing_rad, point.range_m));
    }
    append(streamed, stream.finish());
    expect_same(streamed, expected.breakpoints);
  }
}

TEST(BreakpointStream, BackwardSteps_ResultIsUnchanged) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(43);
  const PolarScan scan = noisy_scan(source, *map, {1.1, 0.9, 0.4});
  std::vector<PolarPoint> shuffled(scan.points().begin(), scan.points().end());
  for (std::size_t i = 0; i + 1 < shuffled.size(); i += 23) std::swap(shuffled[i], shuffled[i + 1]);

  const auto run = [&](std::span<const PolarPoint> points) {
    BreakpointStream stream({}, {});
    std::vector<Breakpoint> streamed;
    stream.begin(scan.spacing_rad(), Sweep::kCounterClockwise);
    for (const PolarPoint& point : points) {
      append(streamed, stream.add(point.bearing_rad, point.range_m));
    }
    append(streamed, stream.finish());
    return streamed;
  };
  expect_same(run(shuffled), run(scan.points()));
}

TEST(BreakpointStream, Breakpoint_IsFinalBeforeScanEnds) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(44);
  const PolarScan scan = testing::polar(source.take(*map, {1.5, 1, 0.3}));
  BreakpointStream stream({}, {});
  stream.begin(scan.spacing_rad(), Sweep::kCounterClockwise);
  std::size_t early = 0;
  std::size_t all = 0;
  for (const PolarPoint& point : scan.points()) {
    for (const Breakpoint& breakpoint : stream.add(point.bearing_rad, point.range_m)) {
      const double seen_rad = std::atan2(breakpoint.position.y(), breakpoint.position.x());
      EXPECT_GT(point.bearing_rad, seen_rad);
      // The next wall spans 113 degrees at most from the middle.
      EXPECT_LT(point.bearing_rad - seen_rad, radians(140));
      ++early;
    }
  }
  all = early + stream.finish().size();
  EXPECT_EQ(all, 4U);
  EXPECT_GE(early, 1U);
}

TEST(BreakpointStream, SeamAnywhere_NoBreakpoint) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(45);
  const PolarScan scan = testing::polar(source.take(*map, {1.3, 0.8, 0.1}));
  BreakpointStream stream({}, {});
  for (std::size_t start = 0; start < scan.size(); start += 37) {
    std::vector<Breakpoint> streamed;
    stream.begin(scan.spacing_rad(), Sweep::kCounterClockwise);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const PolarPoint& point = scan[(start + i) % scan.size()];
      append(streamed, stream.add(point.bearing_rad, point.range_m));
    }
    append(streamed, stream.finish());
    EXPECT_EQ(streamed.size(), 4U) << "begun at " << scan[start].bearing_rad;
  }
}

TEST(BreakpointStream, ReturnsBeyondTheCircle_AreIgnored) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(46);
  const PolarScan scan = testing::polar(source.take(*map, {1.3, 0.8, 0.1}));
  BreakpointStream stream({}, {});
  stream.begin(scan.spacing_rad(), Sweep::kCounterClockwise);
  std::vector<Breakpoint> streamed;
  for (int round = 0; round < 3; ++round) {
    for (const PolarPoint& point : scan.points()) {
      append(streamed, stream.add(point.bearing_rad, point.range_m));
    }
  }
  append(streamed, stream.finish());
  EXPECT_EQ(streamed.size(), 4U);
  const std::size_t walls = stream.detection().segments.size();
  EXPECT_TRUE(stream.finish().empty());
  EXPECT_EQ(stream.detection().segments.size(), walls);
}

TEST(BreakpointStream, InvalidRanges_AreIgnored) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(47);
  const PolarScan scan = testing::polar(source.take(*map, {1.3, 0.8, 0.1}));
  BreakpointStream stream({}, {});
  for (int round = 0; round < 2; ++round) {
    stream.begin(scan.spacing_rad(), Sweep::kCounterClockwise);
    std::vector<Breakpoint> streamed;
    for (const PolarPoint& point : scan.points()) {
      for (const double none : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        EXPECT_TRUE(stream.add(point.bearing_rad, none).empty());
      }
      EXPECT_TRUE(stream.add(std::nan(""), 1).empty());
      append(streamed, stream.add(point.bearing_rad, point.range_m));
    }
    append(streamed, stream.finish());
    EXPECT_EQ(streamed.size(), 4U);
  }
}

}  // namespace
}  // namespace cornerd::core
