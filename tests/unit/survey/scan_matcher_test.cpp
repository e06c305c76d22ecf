// SPDX-License-Identifier: MIT
#include "survey/scan_matcher.hpp"

#include <gtest/gtest.h>

#include "mapped_scene.hpp"

namespace cornerd::survey {
namespace {

using core::Vec2;

/// A room of 4 x 3 m with the origin inside it, and a second wall behind one of its own.
class ScanMatcherTest : public testing::Test {
 protected:
  ScanMatcherTest() {
    const std::vector<std::pair<Vec2, Vec2>> walls = {
        {{-1, -1}, {3, -1}}, {{3, -1}, {3, 2}}, {{3, 2}, {-1, 2}}, {{-1, 2}, {-1, -1}}};
    for (const auto& [from, to] : walls) {
      faces_.push_back(face_between(from, to));
      seen_.push_back(sighting_of(from, to, pose_));
    }
  }
  core::Pose2 pose_{0.5, 0.3, 0.4};
  std::vector<MappedFace> faces_;
  std::vector<Sighting> seen_;
  std::vector<std::uint32_t> faces_of_;
  ScanMatcher matcher_;
  core::Covariance3 vague_ = core::Covariance3::Identity();
};

TEST_F(ScanMatcherTest, Match_FromBesideTheTruth_FindsIt) {
  const core::Pose2 prior{0.42, 0.36, 0.5};
  const ScanMatch match = matcher_.match(seen_, faces_, prior, vague_, {0.2, 0.2}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.x_m, pose_.x_m, 1e-4);
  EXPECT_NEAR(match.T_map_lidar.y_m, pose_.y_m, 1e-4);
  EXPECT_NEAR(match.T_map_lidar.theta_rad, pose_.theta_rad, 1e-4);
  EXPECT_EQ(faces_of_, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_DOUBLE_EQ(match.matched_share, 1);
}

TEST_F(ScanMatcherTest, Match_OppositeSideOfAThinWall_IsAnotherFace) {
  // The other side of the right wall, 2 cm behind it, looking away.
  faces_[1] = face_between({3.02, 2}, {3.02, -1});
  ScanMatcher::assign(seen_, faces_, pose_, {0.1, 0.1}, faces_of_);
  EXPECT_EQ(faces_of_[1], kNoFace);
}

TEST_F(ScanMatcherTest, Match_WallBeyondADoor_IsAnotherFace) {
  const Sighting beyond = sighting_of({3, 2.9}, {3, 4}, pose_);
  ScanMatcher::assign(std::span(&beyond, 1), faces_, pose_, kExactReach, faces_of_);
  EXPECT_EQ(faces_of_[0], kNoFace);
}

TEST_F(ScanMatcherTest, Match_OneMovedThing_DoesNotPull) {
  seen_.push_back(sighting_of({2.4, -0.85}, {2.8, -0.85}, pose_));  // a box before the wall
  const ScanMatch match = matcher_.match(seen_, faces_, pose_, vague_, {0.2, 0.2}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.y_m, pose_.y_m, 0.002);
  EXPECT_EQ(faces_of_[4], kNoFace);
}

TEST_F(ScanMatcherTest, Match_ParallelWallsAlone_KeepsThePriorAlongThem) {
  const std::vector<Sighting> two = {seen_[0], seen_[2]};
  const core::Covariance3 prior_covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  const core::Pose2 prior{0.55, 0.33, 0.41};
  const ScanMatch match =
      matcher_.match(two, faces_, prior, prior_covariance, {0.1, 0.1}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.x_m, 0.55, 1e-3);
  EXPECT_NEAR(match.T_map_lidar.y_m, pose_.y_m, 1e-3);
  EXPECT_GT(match.covariance(0, 0), 20 * match.covariance(1, 1));
}

TEST_F(ScanMatcherTest, Match_ParallelWallsAlone_IsNotByTheWalls) {
  const std::vector<Sighting> two = {seen_[0], seen_[2]};
  const core::Covariance3 sure = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
  const ScanMatch match = matcher_.match(two, faces_, pose_, sure, {0.1, 0.1}, faces_of_);
  ASSERT_TRUE(match.valid);  // the prior tells the way along them
  EXPECT_FALSE(match.by_walls());
  EXPECT_GT(match.own_sigma_m, 1);
}

TEST_F(ScanMatcherTest, Match_ParallelWallsAndOneAcross_IsByTheWalls) {
  const std::vector<Sighting> three = {seen_[0], seen_[1], seen_[2]};
  const core::Covariance3 sure = Eigen::Vector3d(1e-6, 1e-6, 1e-6).asDiagonal();
  const ScanMatch match = matcher_.match(three, faces_, pose_, sure, {0.1, 0.1}, faces_of_);
  EXPECT_TRUE(match.by_walls());
  EXPECT_LT(match.own_sigma_m, 0.01);
}

TEST_F(ScanMatcherTest, MatchCautiously_WallBesideAFace_TellsNothingOfThePlace) {
  // The end of another wall, 0.1 m before the line of the right wall and beside its end.
  faces_[1] = face_between({3, -1}, {3, 1});
  const std::vector<Sighting> seen = {seen_[0], sighting_of({2.9, 1.1}, {2.9, 1.4}, pose_),
                                      seen_[2]};
  const core::Covariance3 sure = Eigen::Vector3d(1e-3, 1e-3, 1e-3).asDiagonal();
  const ScanMatch bold = matcher_.match(seen, faces_, pose_, sure, {0.15, 0.1}, faces_of_);
  EXPECT_GT(bold.T_map_lidar.x_m, pose_.x_m + 0.05);
  matcher_.set_cautious(true);
  const ScanMatch match = matcher_.match(seen, faces_, pose_, sure, {0.15, 0.1}, faces_of_);
  ASSERT_TRUE(match.valid);
  EXPECT_NEAR(match.T_map_lidar.x_m, pose_.x_m, 1e-3);
  EXPECT_FALSE(match.by_walls());
}

TEST_F(ScanMatcherTest, Match_NothingKnown_IsNotValid) {
  const ScanMatch match = matcher_.match(seen_, {}, pose_, vague_, {0.2, 0.2}, faces_of_);
  EXPECT_FALSE(match.valid);
}

}  // namespace
}  // namespace cornerd::survey
