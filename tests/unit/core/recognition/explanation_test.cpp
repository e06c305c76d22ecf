// SPDX-License-Identifier: MIT
#include "core/recognition/explanation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

class BeamLikelihoodTest : public ::testing::Test {
 protected:
  BeamLikelihood at(const Pose2& T_map_lidar, const Scan& scan) {
    const PolarScan points = testing::polar(scan);
    const auto hits = prediction_.cast(*map_, T_map_lidar, points.points());
    return beam_likelihood(*map_, points.points(), hits, T_map_lidar, {}, 1, 0);
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  RayCaster prediction_{12};
  testing::ScanSource source_{41};
};

TEST_F(BeamLikelihoodTest, TruePoseClearScan_NearlyAllHits) {
  const Pose2 T_map_lidar{1, 1, 0.5};
  const BeamLikelihood likelihood = at(T_map_lidar, source_.take(*map_, T_map_lidar));
  EXPECT_EQ(likelihood.rays, 540U);
  EXPECT_GT(likelihood.hit_share(), 0.99);
  EXPECT_LT(likelihood.violation_share(), 0.01);
}

TEST_F(BeamLikelihoodTest, EveryRay_IsCountedOnce) {
  const BeamLikelihood likelihood = at({1.4, 1.2, 2.5}, source_.take(*map_, {1, 1, 0.5}));
  EXPECT_EQ(
      likelihood.hits + likelihood.near_hits + likelihood.shorts + likelihood.free_space_violations,
      likelihood.rays);
}

TEST_F(BeamLikelihoodTest, WrongPose_LowerLikelihoodAndViolations) {
  const Pose2 T_map_lidar{1, 1, 0.5};
  const Scan scan = source_.take(*map_, T_map_lidar);
  const BeamLikelihood wrong = at({3.2, 0.9, 0.5}, scan);
  EXPECT_GT(wrong.violation_share(), 0.1);
  EXPECT_LT(wrong.log_likelihood + 500, at(T_map_lidar, scan).log_likelihood);
}

TEST_F(BeamLikelihoodTest, ObstacleBeforeWall_CountsOnce) {
  const Pose2 T_map_lidar{1, 1, 0.5};
  const Scan clear = source_.take(*map_, T_map_lidar);
  const auto hidden = [&](std::size_t count) {
    Scan scan;
    for (std::size_t i = 0; i < clear.size(); ++i) {
      Sample sample = clear.samples()[i];
      if (i >= 100 && i < 100 + count) sample.range_m = 0.4F;
      scan.add(sample);
    }
    return at(T_map_lidar, scan);
  };
  const BeamLikelihood small = hidden(30);
  const BeamLikelihood large = hidden(90);
  EXPECT_EQ(small.shorts, 30U);
  EXPECT_EQ(large.shorts, 90U);
  const double by_rays = small.log_likelihood - large.log_likelihood;
  const double by_things = small.log_likelihood_of_obstacles - large.log_likelihood_of_obstacles;
  EXPECT_GT(by_rays, 150);
  EXPECT_LT(std::abs(by_things), by_rays / 3);
}

}  // namespace
}  // namespace cornerd::core
