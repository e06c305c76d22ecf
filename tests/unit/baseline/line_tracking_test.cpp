// SPDX-License-Identifier: MIT
#include "baseline/line_tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../core/fixtures.hpp"

namespace cornerd::baseline {
namespace {

using namespace core;

SegmentTracks lines_of(const PolarScan& points) {
  SegmentTracks tracks;
  tracks.reserve(kMaxSegmentsPerScan);
  EXPECT_EQ(LineTracking({}, {}).track(points, tracks), 0U);
  return tracks;
}

std::uint32_t lines_support(const SegmentTracks& tracks) {
  std::uint32_t support = 0;
  for (const SegmentTrack& wall : tracks) support += wall.support;
  return support;
}

double distance_m(const Line& line, const PolarPoint& point) {
  return std::abs(line.normal.dot(Vec2(point.x_m, point.y_m)) - line.offset_m);
}

TEST(LineTracking, RectangularRoom_FourWallsPlusSeam) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(31);
  testing::ScanOptions exact;
  exact.with_noise = false;
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.5, 2.5, 0.5, 1.5);
    const SegmentTracks tracks = lines_of(testing::polar(source.take(*map, T_map_lidar, exact)));
    EXPECT_GE(tracks.size(), 4U);
    EXPECT_LE(tracks.size(), 5U);
    // With noise a line through two samples can point anywhere: more pieces, but of the same walls.
    const PolarScan points = testing::polar(source.take(*map, T_map_lidar));
    EXPECT_GE(lines_of(points).size(), 4U);
    EXPECT_GT(lines_support(lines_of(points)), points.size() * 95 / 100);
  }
}

TEST(LineTracking, Walls_AreConsecutiveRuns) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(32);
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.5, 2.2, 0.4, 1.5);
    const PolarScan points = testing::polar(source.take(*map, T_map_lidar));
    std::uint32_t free_from = 0;
    for (const SegmentTrack& wall : lines_of(points)) {
      EXPECT_GE(wall.first, free_from);
      EXPECT_EQ(wall.last - wall.first + 1, wall.support);
      EXPECT_LT(wall.last, points.size());
      free_from = wall.last + 1;
    }
  }
}

TEST(LineTracking, SampleBeyondLimit_EndsWall) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(33);
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.5, 2.2, 0.4, 1.5);
    const PolarScan points = testing::polar(source.take(*map, T_map_lidar));
    for (const SegmentTrack& wall : lines_of(points)) {
      if (wall.last + 1 == points.size()) continue;
      EXPECT_GT(distance_m(wall.line, points[wall.last + 1]), LineTrackingConfig().max_distance_m);
    }
  }
}

/// A flat wall half a metre in front of the sensor, 1.2 m wide, whose right part stands `step_m`
/// nearer.
PolarScan stepped_wall(double step_m) {
  Scan scan;
  for (int i = -50; i <= 50; ++i) {
    Sample sample;
    sample.bearing_rad = static_cast<float>(radians(i));
    const double depth_m = i < 0 ? 0.5 - step_m : 0.5;
    sample.range_m = static_cast<float>(depth_m / std::cos(radians(i)));
    scan.add(sample);
  }
  return testing::polar(scan);
}

TEST(LineTracking, StepAboveLimit_EndsWall) {
  EXPECT_EQ(lines_of(stepped_wall(0.9 * LineTrackingConfig().max_distance_m)).size(), 1U);
  const SegmentTracks tracks = lines_of(stepped_wall(1.1 * LineTrackingConfig().max_distance_m));
  ASSERT_EQ(tracks.size(), 2U);
  EXPECT_EQ(tracks[0].last, 49U);
  EXPECT_EQ(tracks[1].first, 50U);
}

}  // namespace
}  // namespace cornerd::baseline
