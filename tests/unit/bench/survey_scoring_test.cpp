// SPDX-License-Identifier: MIT
#include "bench/survey_scoring.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cornerd::bench {
namespace {

using core::Vec2;

core::FloorPlan room() {
  core::FloorPlan plan;
  plan.walls = {{{0, 0}, {4, 0}, 0}, {{4, 0}, {4, 3}, 0}, {{4, 3}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}};
  return plan;
}

SurveyScore score(const core::FloorPlan& found, const core::Pose2& start = {}) {
  const std::vector<core::Pose2> poses(20, core::Pose2{2, 1.5, 0});
  return score_survey(core::WallMap(room()), poses, core::WallMap(found), start);
}

TEST(SurveyScoring, TrueMap_PerfectScore) {
  const SurveyScore result = score(room());
  EXPECT_EQ(result.walls_visible, 4U);
  EXPECT_EQ(result.walls_found, 4U);
  EXPECT_EQ(result.invented_m, 0);
  EXPECT_EQ(result.corners_found, 4U);
  EXPECT_NEAR(result.corner_max_m(), 0, 1e-9);
}

TEST(SurveyScoring, AnotherFrame_IsAligned) {
  const core::Pose2 T_map_true = core::Pose2{1, 2, 0.5}.inverse();
  core::FloorPlan found = room();
  for (core::Wall& wall : found.walls) {
    wall.from = T_map_true * wall.from;
    wall.to = T_map_true * wall.to;
  }
  const SurveyScore result = score(found, {1.1, 1.95, 0.52});
  EXPECT_NEAR(result.corner_max_m(), 0, 1e-6);
  EXPECT_NEAR(result.T_true_map.x_m, 1, 1e-6);
  EXPECT_EQ(result.walls_found, 4U);
}

TEST(SurveyScoring, MissingWall_IsCounted) {
  core::FloorPlan found = room();
  found.walls.pop_back();
  const SurveyScore result = score(found);
  EXPECT_EQ(result.walls_found, 3U);
  ASSERT_EQ(result.missed.size(), 1U);
  EXPECT_NEAR((result.missed[0] - Vec2(0, 1.5)).norm(), 0, 1e-9);
}

TEST(SurveyScoring, ExtraWall_IsInvented) {
  core::FloorPlan found = room();
  found.walls.push_back({{1, 1}, {2, 1}, 0});
  EXPECT_NEAR(score(found).invented_m, 2, 0.1) << "it has two sides";
}

TEST(SurveyScoring, DisplacedCorner_RaisesMaximum) {
  core::FloorPlan found = room();
  found.walls[0].to = found.walls[1].from = {4.03, 0};
  EXPECT_NEAR(score(found).corner_max_m(), 0.0225, 0.003) << "less what the alignment takes of it";
}

}  // namespace
}  // namespace cornerd::bench
