// SPDX-License-Identifier: MIT
#include "core/recognition/beam_likelihood.hpp"

#include <gtest/gtest.h>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

class BeamLikelihoodTest : public ::testing::Test {
 protected:
  BeamLikelihood at(const Pose2& T_map_lidar, const Scan& scan) {
    const PolarScan points = testing::polar(scan);
    const auto hits = prediction_.cast(*map_, T_map_lidar, points.points());
    return beam_likelihood(*map_, points.points(), hits, T_map_lidar, {}, 1);
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

TEST_F(BeamLikelihoodTest, ObstacleBeforeWall_IsShort) {
  const Pose2 T_map_lidar{1, 1, 0.5};
  const Scan clear = source_.take(*map_, T_map_lidar);
  Scan hidden;
  for (Sample sample : clear.samples()) {
    if (hidden.size() >= 100 && hidden.size() < 130) sample.range_m = 0.4F;
    hidden.add(sample);
  }
  EXPECT_EQ(at(T_map_lidar, hidden).shorts, 30U);
  EXPECT_LT(at(T_map_lidar, hidden).log_likelihood, at(T_map_lidar, clear).log_likelihood);
}

BeamLikelihood hits_of(std::size_t rays, std::size_t hits) {
  return {.rays = rays, .hits = hits, .shorts = rays - hits};
}

TEST(BeamLikelihood, NearlyAllHits_IsConclusive) {
  EXPECT_TRUE(hits_of(800, 780).is_conclusive(false));
  EXPECT_FALSE(hits_of(800, 770).is_conclusive(false));
  EXPECT_TRUE(hits_of(800, 770).is_conclusive(true));
  EXPECT_FALSE(hits_of(99, 99).is_conclusive(true));
}

TEST(BeamLikelihood, HalfOfTheRaysOnWalls_ExplainsAScan) {
  EXPECT_TRUE(hits_of(800, 420).explains_scan());
  EXPECT_FALSE(hits_of(800, 400).explains_scan());
  EXPECT_FALSE(hits_of(40, 30).explains_scan());
  BeamLikelihood through = hits_of(800, 700);
  through.free_space_violations = 80;
  EXPECT_FALSE(through.explains_scan());
}

}  // namespace
}  // namespace cornerd::core
