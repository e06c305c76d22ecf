// SPDX-License-Identifier: MIT
#include "core/recognition/beam_model.hpp"

#include <gtest/gtest.h>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

constexpr double kMaxMapSigma_m = 1;

class BeamModelTest : public ::testing::Test {
 protected:
  BeamStatistics statistics(const Scan& scan, const WallMap& map, const Pose2& T_map_lidar) {
    const PolarScan points = testing::polar(scan);
    BeamModel model(map, {});
    const auto hits = ray_caster_.cast(map, T_map_lidar, points.points());
    model.meet(points.points(), hits, T_map_lidar, points.spacing_rad(), 1);
    if_exact_ = model.statistics_if_exact();
    return model.statistics(kMaxMapSigma_m);
  }

  /// This many neighbouring rays end far behind the wall.
  static Scan with_rays_through(const Scan& whole, std::size_t count) {
    Scan scan;
    for (Sample sample : whole.samples()) {
      if (scan.size() >= 100 && scan.size() < 100 + count) sample.range_m += 1;
      scan.add(sample);
    }
    return scan;
  }

  BeamCounts counts(const Scan& scan, const Pose2& T_map_lidar) {
    const PolarScan points = testing::polar(scan);
    BeamModel model(*map_, {});
    const auto hits = ray_caster_.cast(*map_, T_map_lidar, points.points());
    model.meet(points.points(), hits, T_map_lidar, points.spacing_rad(), 1);
    return model.counts();
  }

  /// The room with the wall on the right this much farther out.
  static FloorPlan widened(double by_m) {
    FloorPlan plan = testing::rectangular_room(3, 2);
    for (Wall& wall : plan.walls) {
      for (Vec2* end : {&wall.from, &wall.to}) {
        if (end->x() > 1.5) end->x() += by_m;
      }
    }
    return plan;
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::rectangular_room(3, 2));
  Pose2 T_map_lidar_{1, 0.8, 0.4};
  RayCaster ray_caster_{12};
  testing::ScanSource source_{72};
  BeamStatistics if_exact_;  ///< of the last statistics()
};

TEST_F(BeamModelTest, TruePose_AllRaysHitAnExactMap) {
  const BeamStatistics found = statistics(source_.take(*map_, T_map_lidar_), *map_, T_map_lidar_);
  EXPECT_GT(static_cast<double>(found.hits), 0.98 * static_cast<double>(found.rays));
  EXPECT_EQ(found.hits + found.shorts + found.free_space_violations, found.rays);
  EXPECT_EQ(found.map_sigma_m, BeamModel::kMapSigmas_m.front());
  EXPECT_GT(found.log_likelihood, 30);
}

TEST_F(BeamModelTest, WrongPose_IsLessLikelyThanAnyPlace) {
  EXPECT_LT(statistics(source_.take(*map_, T_map_lidar_), *map_, {1.5, 1.2, 1.9}).log_likelihood,
            0);
}

TEST_F(BeamModelTest, WallFarBehindItsPlace_IsUnseenAndMissedByItsRays) {
  const Scan scan = source_.take(*map_, T_map_lidar_);
  const BeamStatistics found = statistics(scan, *map_, T_map_lidar_);
  EXPECT_EQ(found.unseen_faces, 0);
  EXPECT_GT(found.predicted_hits, 0.95 * found.predicted);
  const WallMap narrow(widened(-0.5));
  const BeamStatistics missed = statistics(scan, narrow, T_map_lidar_);
  EXPECT_EQ(missed.unseen_faces, 1);
  EXPECT_LT(missed.predicted_hits, found.predicted_hits - 30);
  EXPECT_GT(missed.rays_through, 10);
}

TEST_F(BeamModelTest, DisplacedWall_CostsItsOffsetOnce) {
  const Scan scan = source_.take(*map_, T_map_lidar_);
  const double exact = statistics(scan, *map_, T_map_lidar_).log_likelihood;
  const BeamStatistics off = statistics(scan, *testing::make_map(widened(0.04)), T_map_lidar_);
  EXPECT_GE(off.map_sigma_m, 0.025);
  EXPECT_EQ(off.free_space_violations + off.shorts, 0U);
  EXPECT_LT(off.log_likelihood, exact);
  EXPECT_GT(off.log_likelihood, exact - 30);
}

TEST_F(BeamModelTest, MissingWall_CostsMoreThanAnObject) {
  const Scan scan = source_.take(*map_, T_map_lidar_);
  const double behind =
      statistics(scan, *testing::make_map(widened(-0.5)), T_map_lidar_).log_likelihood;
  const double before =
      statistics(scan, *testing::make_map(widened(0.5)), T_map_lidar_).log_likelihood;
  EXPECT_LT(behind, before);
}

TEST_F(BeamModelTest, FewRaysThroughAWall_AreOnItsEdge_OfADenseLidarMore) {
  testing::ScanOptions lidar;
  lidar.samples = 800;
  const Scan sparse = source_.take(*map_, T_map_lidar_, lidar);
  lidar.samples = 3200;
  const Scan dense = source_.take(*map_, T_map_lidar_, lidar);
  const auto missing_walls = [&](const Scan& whole, std::size_t count) {
    return statistics(with_rays_through(whole, count), *map_, T_map_lidar_).missing_walls;
  };
  EXPECT_EQ(missing_walls(sparse, 2), 0);
  EXPECT_EQ(missing_walls(sparse, 4), 1);
  EXPECT_EQ(missing_walls(dense, 7), 0);
  EXPECT_EQ(missing_walls(dense, 12), 1);
}

TEST_F(BeamModelTest, RaysNearAnExactWall_AreNeitherHitsNorThroughIt) {
  const Scan scan = source_.take(*testing::make_map(widened(0.04)), T_map_lidar_);
  statistics(scan, *map_, T_map_lidar_);
  EXPECT_LT(if_exact_.hits + 30, if_exact_.rays);
  EXPECT_EQ(if_exact_.missing_walls, 0);
  EXPECT_GT(if_exact_.predicted_hits, 0.95 * if_exact_.predicted);
  statistics(with_rays_through(scan, 30), *map_, T_map_lidar_);
  EXPECT_GE(if_exact_.missing_walls, 1);
}

TEST_F(BeamModelTest, InexactMap_TrustsItsWallsLess) {
  const Scan scan = source_.take(*map_, T_map_lidar_);
  FloorPlan plan = widened(0.5);
  const double measured = statistics(scan, *testing::make_map(plan), T_map_lidar_).log_likelihood;
  plan.sigma_m = 0.04;
  EXPECT_GT(statistics(scan, *testing::make_map(plan), T_map_lidar_).log_likelihood, measured);
}

TEST_F(BeamModelTest, EveryRay_IsCountedOnce) {
  const BeamCounts rays = counts(source_.take(*map_, T_map_lidar_), {1.4, 1.2, 2.5});
  EXPECT_EQ(rays.hits + rays.near_hits + rays.shorts + rays.free_space_violations, rays.rays);
}

TEST_F(BeamModelTest, TruePose_IsLikelierThanAWrongOne) {
  const Scan scan = source_.take(*map_, T_map_lidar_);
  const BeamCounts right = counts(scan, T_map_lidar_);
  EXPECT_GT(right.hit_share(), 0.98);
  EXPECT_LT(right.violation_share(), 0.01);
  const BeamCounts wrong = counts(scan, {1.5, 1.2, 1.9});
  EXPECT_GT(wrong.violation_share(), 0.1);
  EXPECT_LT(wrong.log_likelihood + 500, right.log_likelihood);
}

TEST_F(BeamModelTest, ObstacleBeforeWall_IsShort) {
  const Scan clear = source_.take(*map_, T_map_lidar_);
  Scan hidden;
  for (Sample sample : clear.samples()) {
    if (hidden.size() >= 100 && hidden.size() < 130) sample.range_m = 0.3F;
    hidden.add(sample);
  }
  EXPECT_NEAR(static_cast<double>(counts(hidden, T_map_lidar_).shorts), 30, 2);
}

BeamCounts hits_of(std::size_t rays, std::size_t hits) {
  return {.rays = rays, .hits = hits, .shorts = rays - hits};
}

TEST(BeamCounts, NearlyAllHits_IsConclusive) {
  EXPECT_TRUE(hits_of(800, 780).is_conclusive(false));
  EXPECT_FALSE(hits_of(800, 770).is_conclusive(false));
  EXPECT_TRUE(hits_of(800, 770).is_conclusive(true));
  EXPECT_FALSE(hits_of(99, 99).is_conclusive(true));
}

TEST(BeamCounts, HalfOfTheRaysOnWalls_ExplainsAScan) {
  EXPECT_TRUE(hits_of(800, 420).explains_scan());
  EXPECT_FALSE(hits_of(800, 400).explains_scan());
  EXPECT_FALSE(hits_of(40, 30).explains_scan());
  BeamCounts through = hits_of(800, 700);
  through.free_space_violations = 80;
  EXPECT_FALSE(through.explains_scan());
}

}  // namespace
}  // namespace cornerd::core
