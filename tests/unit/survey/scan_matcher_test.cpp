// SPDX-License-Identifier: MIT
#include "survey/scan_matcher.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// A room of 4 x 3 m around the origin.
class ScanMatcherTest : public testing::Test {
 protected:
  ScanMatcherTest() {
    const std::vector<std::pair<Vec2, Vec2>> walls = {
        {{-1, -1}, {3, -1}}, {{3, -1}, {3, 2}}, {{3, 2}, {-1, 2}}, {{-1, 2}, {-1, -1}}};
    for (const auto& [from, to] : walls) {
      faces_.push_back(face_between(from, to));
      seen_.push_back(observation_of(from, to, pose_));
    }
  }
  core::Pose2 pose_{0.5, 0.3, 0.4};
  std::vector<LineLandmark> faces_;
  std::vector<LineObservation> seen_;
  std::vector<std::uint32_t> faces_of_;
  ScanMatcher matcher_;
  core::Covariance3 vague_ = core::Covariance3::Identity();
};

TEST_F(ScanMatcherTest, Match_PriorOffByCentimetres_FindsTruePose) {
  const core::Pose2 prior{0.42, 0.36, 0.5};
  const ScanMatch match = matcher_.match(seen_, faces_, prior, vague_, {0.2, 0.2}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.x_m, pose_.x_m, 1e-4);
  EXPECT_NEAR(match.T_map_lidar.y_m, pose_.y_m, 1e-4);
  EXPECT_NEAR(match.T_map_lidar.theta_rad, pose_.theta_rad, 1e-4);
  EXPECT_EQ(faces_of_, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_DOUBLE_EQ(match.matched_share, 1);
}

TEST_F(ScanMatcherTest, Assign_OppositeFaceOfThinWall_IsNotMatched) {
  // The other face of the right wall, 2 cm behind it.
  faces_[1] = face_between({3.02, 2}, {3.02, -1});
  ScanMatcher::assign(seen_, faces_, pose_, {0.1, 0.1}, faces_of_);
  EXPECT_EQ(faces_of_[1], kNoFace);
}

TEST_F(ScanMatcherTest, Assign_WallBeyondDoor_IsNotMatched) {
  const LineObservation beyond = observation_of({3, 2.9}, {3, 4}, pose_);
  ScanMatcher::assign(std::span(&beyond, 1), faces_, pose_, kExactRadius, faces_of_);
  EXPECT_EQ(faces_of_[0], kNoFace);
}

TEST_F(ScanMatcherTest, Match_UnmappedBox_DoesNotBiasPose) {
  seen_.push_back(observation_of({2.4, -0.85}, {2.8, -0.85}, pose_));  // a box in front of the wall
  const ScanMatch match = matcher_.match(seen_, faces_, pose_, vague_, {0.2, 0.2}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.y_m, pose_.y_m, 0.002);
  EXPECT_EQ(faces_of_[4], kNoFace);
}

TEST_F(ScanMatcherTest, Match_ParallelWalls_KeepsPriorAlongThem) {
  const std::vector<LineObservation> two = {seen_[0], seen_[2]};
  const core::Covariance3 prior_covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  const core::Pose2 prior{0.55, 0.33, 0.41};
  const ScanMatch match =
      matcher_.match(two, faces_, prior, prior_covariance, {0.1, 0.1}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.x_m, 0.55, 1e-3);
  EXPECT_NEAR(match.T_map_lidar.y_m, pose_.y_m, 1e-3);
  EXPECT_GT(match.covariance(0, 0), 20 * match.covariance(1, 1));
}

TEST_F(ScanMatcherTest, Match_ParallelWalls_IsNotConstrained) {
  const std::vector<LineObservation> two = {seen_[0], seen_[2]};
  const core::Covariance3 sure = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
  const ScanMatch match = matcher_.match(two, faces_, pose_, sure, {0.1, 0.1}, faces_of_);
  ASSERT_TRUE(match.valid);  // by the prior
  EXPECT_FALSE(match.is_constrained());
  EXPECT_GT(match.weakest_sigma_m, 1);
}

TEST_F(ScanMatcherTest, Match_ParallelWallsAndOneAcross_IsConstrained) {
  const std::vector<LineObservation> three = {seen_[0], seen_[1], seen_[2]};
  const core::Covariance3 sure = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
  const ScanMatch match = matcher_.match(three, faces_, pose_, sure, {0.1, 0.1}, faces_of_);
  EXPECT_TRUE(match.is_constrained());
  EXPECT_LT(match.weakest_sigma_m, 0.01);
}

TEST_F(ScanMatcherTest, MatchRequiringOverlap_LineBesideFace_IsIgnored) {
  // The end of another wall, 0.1 m in front of the right wall's line and beside its end.
  faces_[1] = face_between({3, -1}, {3, 1});
  const std::vector<LineObservation> seen = {
      seen_[0], observation_of({2.9, 1.1}, {2.9, 1.4}, pose_), seen_[2]};
  const core::Covariance3 sure = Eigen::Vector3d(1e-3, 1e-3, 1e-3).asDiagonal();
  const ScanMatch bold = matcher_.match(seen, faces_, pose_, sure, {0.15, 0.1}, faces_of_);
  EXPECT_GT(bold.T_map_lidar.x_m, pose_.x_m + 0.05);
  matcher_.set_requires_overlap(true);
  const ScanMatch match = matcher_.match(seen, faces_, pose_, sure, {0.15, 0.1}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.x_m, pose_.x_m, 1e-3);
  EXPECT_FALSE(match.is_constrained());
}

TEST_F(ScanMatcherTest, Match_NoFaces_IsInvalid) {
  const ScanMatch match = matcher_.match(seen_, {}, pose_, vague_, {0.2, 0.2}, faces_of_);
  EXPECT_FALSE(match.valid);
}

}  // namespace
}  // namespace cornerd::survey
