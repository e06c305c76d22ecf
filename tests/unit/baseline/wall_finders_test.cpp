// SPDX-License-Identifier: MIT
// Common properties of the baselines, and their differences.
#include "baseline/wall_finders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "../core/fixtures.hpp"
#include "core/breakpoint/detector.hpp"

namespace cornerd::baseline {
namespace {

using namespace core;

const Breakpoint* nearest(const Detection& detection, const Pose2& T_map_lidar, const Vec2& point) {
  const auto distance = [&](const Breakpoint& breakpoint) {
    return (T_map_lidar * breakpoint.position - point).norm();
  };
  const auto found = std::min_element(
      detection.breakpoints.begin(), detection.breakpoints.end(),
      [&](const Breakpoint& a, const Breakpoint& b) { return distance(a) < distance(b); });
  return found != detection.breakpoints.end() && distance(*found) < 0.03 ? &*found : nullptr;
}

std::size_t count_walls(std::string_view method, const Scan& scan) {
  DetectorConfig config;
  config.finder = wall_finder(method);
  Detector detector(config, {});
  Detection detection;
  detector.detect(testing::polar(scan), detection);
  EXPECT_EQ(detection.overflowed, 0U);
  return detection.segments.size();
}

TEST(WallFinder, EachMethod_UsesItsOwnLimits) {
  // A step below the baselines' limit of 30 mm, but above the noise model of ALTBD.
  FloorPlan plan = testing::rectangular_room(3, 2);
  plan.walls.push_back({{1.5, 0.0125}, {3, 0.0125}, 0.025});
  testing::ScanSource source(26);
  testing::ScanOptions exact;
  exact.with_noise = false;
  const Scan stepped = source.take(WallMap(plan), {1.2, 1, 0}, exact);
  EXPECT_EQ(count_walls("altbd", stepped), 5U);
  EXPECT_EQ(count_walls("abd-iepf", stepped), 4U);
  EXPECT_EQ(count_walls("lt", stepped), 4U);

  // A gap without returns in the upper wall, as wide as a door: wider than lambda of ABD and than
  // max_gap of ALTBD. LT continues over any gap.
  const Scan whole = source.take(*testing::make_map(testing::rectangular_room(3, 2)), {1.2, 1, 0});
  Scan gap;
  for (const Sample& sample : whole.samples()) {
    if (std::abs(sample.bearing_rad - kPi / 2) > radians(11)) gap.add(sample);
  }
  EXPECT_EQ(count_walls("altbd", gap), 5U);
  EXPECT_EQ(count_walls("abd-iepf", gap), 5U);
  EXPECT_EQ(count_walls("lt", gap), 4U);
}

TEST(WallFinder, LShapedRoom_EachMethodFindsInnerCorners) {
  const auto map = testing::make_map(testing::l_shaped_room());
  for (const std::string_view method : {"altbd", "abd-iepf", "lt"}) {
    DetectorConfig config;
    config.finder = wall_finder(method);
    Detector detector(config, {});
    Detection detection;
    testing::ScanSource source(27);
    int found = 0;
    for (int k = 0; k < 20; ++k) {
      const Pose2 T_map_lidar = source.place_in(0.5, 2.2, 0.4, 1.5);
      detector.detect(testing::polar(source.take(*map, T_map_lidar)), detection);
      for (const Vec2& corner : {Vec2(0, 0), Vec2(4, 0), Vec2(4, 1.8), Vec2(2.5, 3), Vec2(0, 3)}) {
        found += nearest(detection, T_map_lidar, corner) != nullptr ? 1 : 0;
      }
    }
    EXPECT_GE(found, 90) << method;
  }
}

class WallFinders : public ::testing::TestWithParam<std::string_view> {
 protected:
  std::size_t track(const PolarScan& points, SegmentTracks& tracks) const {
    return wall_finder(GetParam())({}, {})->track(points, tracks);
  }
  SegmentTracks walls_of(const PolarScan& points) const {
    SegmentTracks tracks;
    tracks.reserve(kMaxSegmentsPerScan);
    EXPECT_EQ(track(points, tracks), 0U);
    return tracks;
  }
};

TEST_P(WallFinders, FewerPointsThanMinSupport_AreNoWall) {
  Scan scan;
  EXPECT_TRUE(walls_of(core::testing::polar(scan)).empty());
  for (std::uint32_t i = 1; i <= DetectorConfig().min_support; ++i) {
    Sample sample;
    sample.bearing_rad = 0.01F * static_cast<float>(i);
    sample.range_m = 1;
    scan.add(sample);
    EXPECT_EQ(walls_of(core::testing::polar(scan)).size(),
              i < DetectorConfig().min_support ? 0U : 1U);
  }
}

TEST_P(WallFinders, TooManyWalls_AreDroppedAndCounted) {
  const auto map = core::testing::make_map(core::testing::rectangular_room(3, 2));
  for (const unsigned seed : {34U, 47U}) {
    core::testing::ScanSource source(seed);
    const PolarScan points = core::testing::polar(source.take(*map, {1.5, 1, 0.3}));
    const std::size_t all = walls_of(points).size();
    SegmentTracks tracks;
    tracks.reserve(2);
    const std::size_t capacity = tracks.capacity();
    EXPECT_EQ(track(points, tracks), all - capacity);
    EXPECT_EQ(tracks.size(), capacity);
  }
}

INSTANTIATE_TEST_SUITE_P(Baselines, WallFinders, ::testing::Values("abd-iepf", "lt"));

}  // namespace
}  // namespace cornerd::baseline
