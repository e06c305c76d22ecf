// SPDX-License-Identifier: MIT
#include "bench/scoring.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "replay/simulator/scan_simulator.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

using core::Breakpoint;
using core::BreakpointKind;
using core::Vec2;
using testing::ElementsAre;

Breakpoint detection(double x_m, double y_m, BreakpointKind kind = BreakpointKind::kCorner) {
  Breakpoint breakpoint;
  breakpoint.position = {x_m, y_m};
  breakpoint.kind = kind;
  return breakpoint;
}

/// A noiseless sensor at (1, 1) in a room of 2 by 3 m, with a wall 18 mm thick at x = 0.4 up to y =
/// 0.7, and another one at y = 2 from x = 0.8 to 1.2 that occludes a part of a third.
class CornerScoring : public testing::Test {
 protected:
  CornerScoring() : map_(plan()), truth_(map_, 12) {
    replay::ScanSimulator simulator(replay::SensorModel::perfect(), 2000, 1);
    core::PolarScan points;
    points.assign(simulator.take(map_, kPlace), 0.15, 12);
    truth_.observe(kPlace, points.points());
  }

  static core::FloorPlan plan() {
    core::FloorPlan plan = replay::make_room()->plan();
    plan.walls.push_back({{0.4, 0}, {0.4, 0.691}, 0.018});
    plan.walls.push_back({{0.8, 2}, {1.2, 2}, 0});
    return plan;
  }

  std::vector<Verdict> judge(const std::vector<Breakpoint>& detections) {
    const auto verdicts = score_.add(detections, truth_);
    return {verdicts.begin(), verdicts.end()};
  }

  static constexpr core::Pose2 kPlace{1, 1, 0};
  core::WallMap map_;
  replay::CornerTruth truth_;
  CornerScore score_;
};

TEST_F(CornerScoring, DetectionWithinSixCentimetres_IsTrue) {
  EXPECT_THAT(judge({detection(1.03, 2.0)}), ElementsAre(Verdict::kTrue));
  EXPECT_THAT(judge({detection(1.07, 2.0)}), ElementsAre(Verdict::kFalse));
  ASSERT_EQ(score_.errors_m().size(), 1u);
  EXPECT_NEAR(score_.errors_m()[0], 0.03, 1e-9);
}

TEST_F(CornerScoring, TwoDetectionsOfACorner_NearerIsTrue) {
  EXPECT_THAT(judge({detection(0.97, 2), detection(0.99, 2), detection(1, 1.97)}),
              ElementsAre(Verdict::kFalse, Verdict::kTrue, Verdict::kFalse));
}

TEST_F(CornerScoring, WallEnd_OneTrueAndOneOneSided) {
  // From (1, 1) the right face and the end of the wall at x = 0.4 are visible.
  const double right_m = 0.409 - 1;
  const double left_m = 0.391 - 1;
  EXPECT_THAT(judge({detection(left_m, -0.3)}), ElementsAre(Verdict::kTrue));
  EXPECT_THAT(
      judge({detection(right_m, -0.3), detection(left_m, -0.3), detection(left_m - 0.02, -0.3)}),
      ElementsAre(Verdict::kTrue, Verdict::kOneSided, Verdict::kFalse));
}

TEST_F(CornerScoring, OcclusionEdge_IsNeitherTrueNorFalse) {
  EXPECT_THAT(judge({detection(0.4, 2), detection(-0.4, 2), detection(0, 2)}),
              ElementsAre(Verdict::kOcclusionEdge, Verdict::kOcclusionEdge, Verdict::kFalse));
  EXPECT_DOUBLE_EQ(score_.precision(), 0);
}

TEST_F(CornerScoring, PrecisionAndRecall_MatchCounts) {
  // The room's four corners and the right foot of the thick wall have 5 returns on both walls; the
  // left foot is occluded. The corner at its end has few returns on 18 mm.
  const std::size_t supported = score_.supported();
  EXPECT_EQ(supported, 0u);
  judge({detection(1, 2), detection(1, -1, BreakpointKind::kTerminal), detection(0.5, 0.5),
         detection(0.2, 1, BreakpointKind::kTerminal)});
  EXPECT_EQ(score_.scans(), 1u);
  EXPECT_EQ(score_.detections(BreakpointKind::kTerminal, Verdict::kTrue), 1u);
  EXPECT_EQ(score_.detections(Verdict::kTrue), 2u);
  EXPECT_GE(score_.visible(), score_.supported());
  EXPECT_DOUBLE_EQ(score_.recall_of_supported(), 2.0 / static_cast<double>(score_.supported()));
  EXPECT_DOUBLE_EQ(score_.recall_of_visible(), 2.0 / static_cast<double>(score_.visible()));
}

TEST_F(CornerScoring, StrictPrecision_OneSidedEndsAreFalse) {
  judge({detection(1, 2), detection(0.2, 1, BreakpointKind::kTerminal)});  // end of the thin wall
  EXPECT_DOUBLE_EQ(score_.precision(), 1);
  EXPECT_DOUBLE_EQ(score_.precision(true), 0.5);
  EXPECT_DOUBLE_EQ(score_.precision_of_corners(true), 1);
}

TEST_F(CornerScoring, Merge_AddsCounts) {
  CornerScore other = score_;
  judge({detection(1, 2), detection(0.5, 0.5)});
  other.merge(score_);
  other.merge(score_);
  EXPECT_EQ(other.scans(), 2u);
  EXPECT_EQ(other.visible(), 2 * score_.visible());
  EXPECT_EQ(other.errors_m().size(), 2u);
  EXPECT_DOUBLE_EQ(other.precision(), 0.5);
}

TEST_F(CornerScoring, NothingDetected_PrecisionOneRecallZero) {
  judge({});
  EXPECT_EQ(score_.precision(), 1);
  EXPECT_EQ(score_.recall_of_visible(), 0);
}

}  // namespace
}  // namespace cornerd::bench
