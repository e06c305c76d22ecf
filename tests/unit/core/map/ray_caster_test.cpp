// SPDX-License-Identifier: MIT
#include "core/map/ray_caster.hpp"

#include <gtest/gtest.h>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

TEST(RayCaster, EveryRay_MatchesSingleRay) {
  const auto map = testing::make_map(testing::l_shaped_room());
  testing::ScanSource source(3);
  RayCaster prediction(12);
  for (int k = 0; k < 50; ++k) {
    const Pose2 T_map_lidar = source.place_in(0.2, 2.3, 0.2, 2.8);
    const PolarScan points = testing::polar(source.take(*map, T_map_lidar));
    const auto hits = prediction.cast(*map, T_map_lidar, points.points());
    ASSERT_EQ(hits.size(), points.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const double range = map->range_along(T_map_lidar.translation(),
                                            T_map_lidar.theta_rad + points[i].bearing_rad, 12);
      EXPECT_NEAR(hits[i].range_m, range, 1e-9);
    }
  }
}

TEST(RayCaster, RayWithoutWall_NoHit) {
  FloorPlan plan;
  plan.walls.push_back({{1, -1}, {1, 1}, 0.1});
  const WallMap map(plan);
  Scan scan;
  for (const double bearing : {-3.0, 0.0, 3.0}) {
    Sample sample;
    sample.bearing_rad = static_cast<float>(bearing);
    sample.range_m = 1;
    scan.add(sample);
  }
  const PolarScan points = testing::polar(scan);
  RayCaster prediction(12);
  const auto hits = prediction.cast(map, {}, points.points());
  EXPECT_EQ(hits[0].face, PredictedHit::kNone);
  EXPECT_NEAR(hits[1].range_m, 0.95, 1e-9);
  EXPECT_EQ(hits[2].range_m, 0);
}

/// Rays every half degree from -pi on; as a float that is less than -pi.
PolarScan full_circle() {
  constexpr int kRays = 720;
  PolarScan points;
  points.begin(kTwoPi / kRays);
  for (int i = 0; i < kRays; ++i) {
    points.append(i == 0 ? -static_cast<float>(kPi) : -kPi + i * kTwoPi / kRays, 1);
  }
  return points;
}

TEST(RayCaster, RayAtTheSeam_EndsNoFace) {
  const auto map = testing::make_map(testing::rectangular_room(3, 2));
  const PolarScan points = full_circle();
  RayCaster prediction(12);
  for (const PredictedHit& hit : prediction.cast(*map, {1.13, 0.83, 0}, points.points())) {
    EXPECT_GT(hit.range_m, 0.5);
    EXPECT_GT(hit.sine, 0);
  }
}

TEST(RayCaster, FaceSeenAlongItself_HidesNothing) {
  const PolarScan points = full_circle();
  RayCaster prediction(12);
  FloorPlan plan;
  plan.walls.push_back({{1, 0.05}, {2, 0.05}, 0.1});
  const WallMap map(plan);
  for (const double x_m : {-3.0, -0.1, 0.3, 2.5}) {
    for (const double y_m : {0.0, 0.1, 1e-17, -1e-17}) {
      for (const double theta_rad : {0.0, 0.7, kPi / 2, -2.0, kPi}) {
        for (const PredictedHit& hit :
             prediction.cast(map, {x_m, y_m, theta_rad}, points.points())) {
          EXPECT_TRUE(hit.face == PredictedHit::kNone || hit.range_m > 0.3) << x_m << ' ' << y_m;
        }
      }
    }
  }
}

}  // namespace
}  // namespace cornerd::core
