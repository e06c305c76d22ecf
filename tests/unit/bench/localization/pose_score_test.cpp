// SPDX-License-Identifier: MIT
#include "bench/localization/pose_score.hpp"

#include <gtest/gtest.h>

namespace cornerd::bench {
namespace {

using core::PoseState;

core::PoseEstimate pose_of(PoseState state, const core::Pose2& T_map_base) {
  core::PoseEstimate estimate;
  estimate.state = state;
  estimate.T_map_base = T_map_base;
  estimate.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  return estimate;
}

TEST(PoseScore, PoseNearTruth_NamedAndRight) {
  PoseScore score;
  score.add(pose_of(PoseState::kFix, {1.03, 2, 0}), {1, 2, 0});
  score.add(pose_of(PoseState::kTracking, {1, 2.04, 0.01}), {1, 2, 0});
  EXPECT_EQ(score.named(), 2u);
  EXPECT_EQ(score.wrong(), 0u);
  EXPECT_NEAR(score.mean_error_m(), 0.035, 1e-12);
  EXPECT_NEAR(score.rmse_m(), std::sqrt((0.0009 + 0.0016) / 2), 1e-12);
  EXPECT_NEAR(score.mean_heading_error_rad(), 0.005, 1e-12);
  EXPECT_NEAR(score.mean_nees(), (9 + 17) / 2.0, 1e-9);
  EXPECT_EQ(score.share_inside_95(), 0);
}

TEST(PoseScore, PoseFarFromTruth_WrongAndNotInTheError) {
  PoseScore score;
  score.add(pose_of(PoseState::kFix, {1.2, 2, 0}), {1, 2, 0});
  score.add(pose_of(PoseState::kFix, {1, 2, 0.2}), {1, 2, 0});
  score.add(pose_of(PoseState::kPredicted, {3, 2, 0}), {1, 2, 0});
  EXPECT_EQ(score.wrong(), 3u);
  EXPECT_EQ(score.named(), 2u);
  EXPECT_EQ(score.predicted(), 1u);
  EXPECT_EQ(score.mean_error_m(), 0);
}

TEST(PoseScore, Ambiguous_CountedWithTruthAmongAlternatives) {
  core::PoseEstimate estimate = pose_of(PoseState::kAmbiguous, {});
  estimate.alternatives = {{{5, 5, 0}, 0.6}, {{1.01, 2, 0}, 0.4}};
  PoseScore score;
  score.add(estimate, {1, 2, 0});
  score.add(estimate, {2, 2, 0});
  score.add(pose_of(PoseState::kLost, {}), {1, 2, 0});
  EXPECT_EQ(score.ambiguous(), 2u);
  EXPECT_EQ(score.ambiguous_with_truth(), 1u);
  EXPECT_EQ(score.lost(), 1u);
  EXPECT_EQ(score.scans(), 3u);
}

TEST(PoseScore, Bound_ScalesTheError) {
  PoseScore score;
  const core::Covariance3 bound = Eigen::Vector3d(2e-4, 2e-4, 1e-4).asDiagonal();
  score.add(pose_of(PoseState::kFix, {1.04, 2, 0}), {1, 2, 0}, bound);
  EXPECT_NEAR(score.bound_m(), 0.02, 1e-12);
  EXPECT_NEAR(score.rmse_over_bound(), 2, 1e-9);
}

}  // namespace

namespace {

core::PoseEstimate answer(core::PoseState state, double p_wrong) {
  core::PoseEstimate estimate;
  estimate.state = state;
  estimate.p_wrong = p_wrong;
  estimate.T_map_base = {1, 2, 0};
  if (state == core::PoseState::kAmbiguous) {
    estimate.T_map_base = {};
    estimate.alternatives = {{{1, 2, 0}, 1 - p_wrong}, {{5, 2, 0}, p_wrong}};
  }
  return estimate;
}

TEST(Reliability, Poses_AreBinnedByPWrong) {
  Reliability reliability;
  reliability.add(answer(core::PoseState::kFix, 1e-8), {1, 2, 0});
  reliability.add(answer(core::PoseState::kFix, 1e-9), {5, 2, 0});
  reliability.add(answer(core::PoseState::kAmbiguous, 0.4), {1, 2, 0});
  reliability.add(answer(core::PoseState::kAmbiguous, 0.3), {5, 2, 0});
  reliability.add(answer(core::PoseState::kLost, 0.5), {5, 2, 0});
  const auto& bins = reliability.bins();
  EXPECT_EQ(bins.front().scans, 2u);
  EXPECT_EQ(bins.front().wrong, 1u);
  EXPECT_EQ(bins.back().scans, 2u);
  EXPECT_EQ(bins.back().wrong, 1u);
  EXPECT_NEAR(bins.back().expected_wrong, 0.7, 1e-12);
}

TEST(Reliability, Sum_CountsBoth) {
  Reliability one;
  one.add(answer(core::PoseState::kAmbiguous, 0.002), {5, 2, 0});
  Reliability sum = one;
  sum.add(one);
  EXPECT_EQ(sum.bins()[3].scans, 2u);
  EXPECT_EQ(sum.bins()[3].wrong, 2u);
}

}  // namespace
}  // namespace cornerd::bench
