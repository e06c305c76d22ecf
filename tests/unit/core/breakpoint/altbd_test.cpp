// SPDX-License-Identifier: MIT
#include "core/breakpoint/altbd.hpp"

#include <gtest/gtest.h>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

struct Tracked {
  SegmentTracks tracks;
  double noise_scale = 0;
};

Tracked altbd_walls(const PolarScan& points, const SensorNoise& noise_model = {}) {
  Altbd altbd({}, noise_model);
  altbd.begin();
  Tracked tracked;
  SegmentTrack wall;
  for (;;) {
    const Altbd::Event event = altbd.next(points, /*ended=*/true, wall);
    if (event == Altbd::Event::kNone) break;
    if (event != Altbd::Event::kWallBegun) tracked.tracks.push_back(wall);
  }
  tracked.noise_scale = altbd.noise_scale();
  return tracked;
}

TEST(Altbd, RectangularRoom_FourWallsPlusSeam) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(11);
  for (int k = 0; k < 20; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.5, 2.5, 0.5, 1.5);
    const PolarScan points = testing::polar(source.take(*map, T_map_lidar));
    const Tracked tracked = altbd_walls(points);
    // The seam at bearing pi cuts a wall or falls into a corner.
    EXPECT_GE(tracked.tracks.size(), 4U);
    EXPECT_LE(tracked.tracks.size(), 5U);
    std::uint32_t support = 0;
    for (const SegmentTrack& wall : tracked.tracks) support += wall.support;
    EXPECT_GT(support, points.size() * 97 / 100);
  }
}

TEST(Altbd, SingleOutliers_DoNotBreakWall) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(12);
  const Scan clean = source.take(*map, {1.5, 1, 0.3});
  Scan scan;
  int index = 0;
  for (Sample sample : clean.samples()) {
    if (index++ % 40 == 20) sample.range_m *= 0.5F;
    scan.add(sample);
  }
  EXPECT_LE(altbd_walls(testing::polar(scan)).tracks.size(), 5U);
}

TEST(Altbd, NoiseTwiceTheModel_IsEstimatedWithFewBreaks) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(13);
  testing::ScanOptions options;
  options.noise = {.floor_m = 0.003, .share = 0.01, .bearing_rad = 2 * SensorNoise{}.bearing_rad};
  const Tracked tracked = altbd_walls(testing::polar(source.take(*map, {1.5, 1, 0.3}, options)));
  EXPECT_LE(tracked.tracks.size(), 7U);  // one wall may break before the noise is estimated
  EXPECT_NEAR(tracked.noise_scale, 2, 0.3);
}

TEST(Altbd, TooFewPoints_NoWall) {
  Scan scan;
  for (std::uint32_t i = 0; i + 1 < DetectorConfig().min_support; ++i) {
    Sample sample;
    sample.bearing_rad = static_cast<float>(0.01 * i);
    sample.range_m = 1;
    scan.add(sample);
  }
  EXPECT_TRUE(altbd_walls(testing::polar(scan)).tracks.empty());
  EXPECT_TRUE(altbd_walls(testing::polar(Scan())).tracks.empty());
}

TEST(Altbd, NoiseOfPreviousScan_IsRetained) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(14);
  testing::ScanOptions options;
  options.noise = {.floor_m = 0.003, .share = 0.01, .bearing_rad = 2 * SensorNoise{}.bearing_rad};
  const PolarScan points = testing::polar(source.take(*map, {1.5, 1, 0.3}, options));
  Altbd altbd({}, {});
  SegmentTrack wall;
  for (int scan = 0; scan < 2; ++scan) {
    altbd.begin();
    if (scan == 1) {
      EXPECT_GT(altbd.noise_scale(), 1.5);
    }
    while (altbd.next(points, true, wall) != Altbd::Event::kNone) {
    }
  }
}

TEST(Altbd, NoiselessScans_GateStaysOpen) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(16);
  testing::ScanOptions exact;
  exact.with_noise = false;
  const PolarScan clean = testing::polar(source.take(*map, {1.5, 1, 0.3}, exact));
  const PolarScan noisy = testing::polar(source.take(*map, {1.5, 1, 0.3}));
  Altbd altbd({}, {});
  SegmentTrack wall;
  for (int scan = 0; scan < 10; ++scan) {
    altbd.begin();
    while (altbd.next(clean, true, wall) != Altbd::Event::kNone) {
    }
  }
  altbd.begin();
  std::uint32_t support = 0;
  for (Altbd::Event event = altbd.next(noisy, true, wall); event != Altbd::Event::kNone;
       event = altbd.next(noisy, true, wall)) {
    if (event != Altbd::Event::kWallBegun) support += wall.support;
  }
  EXPECT_GT(support, noisy.size() * 9 / 10);
}

TEST(Altbd, GrowingWall_BeginAndEndAreReported) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  testing::ScanSource source(15);
  const PolarScan whole = testing::polar(source.take(*map, {1.5, 1, 0.3}));
  PolarScan growing;
  growing.begin(whole.spacing_rad());
  Altbd altbd({}, {});
  altbd.begin();
  SegmentTrack wall;
  std::vector<Altbd::Event> events;
  for (const PolarPoint& point : whole.points()) {
    growing.append(point.bearing_rad, point.range_m);
    const Altbd::Event event = altbd.next(growing, /*ended=*/false, wall);
    if (event != Altbd::Event::kNone) events.push_back(event);
    if (event == Altbd::Event::kWallBegun) {
      EXPECT_GT(wall.support, ExtractionConfig().short_wall_samples);
      EXPECT_LT(wall.support, 3 * ExtractionConfig().short_wall_samples);
    }
  }
  ASSERT_GE(events.size(), 7U);
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i], i % 2 == 0 ? Altbd::Event::kWallBegun : Altbd::Event::kWallEnded);
  }
}

}  // namespace
}  // namespace cornerd::core
