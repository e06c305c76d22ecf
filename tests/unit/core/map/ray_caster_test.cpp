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

}  // namespace
}  // namespace cornerd::core
