// SPDX-License-Identifier: MIT
#include "bench/corner_experiment.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

std::vector<MethodScore> score_rooms(std::size_t positions, std::uint64_t seed) {
  const std::vector maps = {replay::make_room(), replay::make_room()};
  return score_methods(maps, paper_methods(), {}, 400, positions, seed);
}

TEST(ScoreMethods, EmptyRoom_AllCornersFound) {
  std::size_t told = 0;
  const std::vector maps = {replay::make_room()};
  const auto scores =
      score_methods(maps, paper_methods(), {}, 400, 20, 3, [&](std::size_t done) { told = done; });
  ASSERT_EQ(scores.size(), 3u);
  EXPECT_EQ(told, 20u);
  EXPECT_EQ(scores[0].method.name, "altbd");
  EXPECT_EQ(scores[0].score.scans(), 20u);
  EXPECT_EQ(scores[0].score.supported(), 80u);
  EXPECT_GT(scores[0].score.recall_of_supported(), 0.95);
  EXPECT_GT(scores[0].score.precision(), 0.98);
}

TEST(ScoreMethods, Positions_AreDividedAmongMaps) {
  EXPECT_EQ(score_rooms(5, 1)[0].score.scans(), 5u);
  EXPECT_EQ(score_rooms(1, 1)[0].score.scans(), 1u);
}

TEST(ScoreMethods, SameSeed_SameScore) {
  EXPECT_EQ(score_rooms(4, 7)[0].score.errors_m(), score_rooms(4, 7)[0].score.errors_m());
  EXPECT_NE(score_rooms(4, 7)[0].score.errors_m(), score_rooms(4, 8)[0].score.errors_m());
}

TEST(DefaultConditions, All_FourSensors) {
  const auto conditions = default_conditions();
  ASSERT_EQ(conditions.size(), 4u);
  EXPECT_DOUBLE_EQ(conditions[0].sensor.noise.share, 0.005);
  EXPECT_DOUBLE_EQ(conditions[3].sensor.noise.floor_m, 0.003);
  EXPECT_DOUBLE_EQ(conditions[3].sensor.missing, 1.0 / 3);
}

}  // namespace
}  // namespace cornerd::bench
