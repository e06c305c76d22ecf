// SPDX-License-Identifier: MIT
#include "core/estimate/wall_offset_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "../fixtures.hpp"
#include "core/estimate/refinement.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

constexpr double kSigma_m = 0.03;
constexpr double kOff_m = 0.02;

/// The room's upper walls (2 and 4) are farther up than its map says.
class WallOffsetFilterTest : public ::testing::Test {
 protected:
  static FloorPlan drawn() {
    FloorPlan plan = testing::l_shaped_room();
    plan.sigma_m = kSigma_m;
    return plan;
  }
  static FloorPlan built() {
    FloorPlan plan = testing::l_shaped_room();
    for (Wall& wall : plan.walls) {
      for (Vec2* end : {&wall.from, &wall.to}) end->y() += end->y() > 1.5 ? kOff_m : 0;
    }
    return plan;
  }
  /// `direction_share`: of walls that may be turned.
  RefinedPose refine(const Pose2& T_map_lidar, double direction_share = 0) {
    const PolarScan points = testing::polar(source_.take(*building_, T_map_lidar));
    RefinedPose refined = refinement_.refine(*map_, T_map_lidar, 0.02, points.points(),
                                             points.points(), 1, kSigma_m, nullptr, &filter_);
    if (direction_share == 0) return refined;
    refined.direction_share = direction_share;
    return refinement_.refine_directions(*map_, refined, points.points(), 1, kSigma_m, &filter_);
  }
  void learn(int scans, double direction_share = 0) {
    for (int k = 0; k < scans; ++k) {
      const RefinedPose refined = refine(source_.place_in(0.4, 2.2, 0.4, 2.6), direction_share);
      ASSERT_TRUE(refined.valid);
      filter_.learn(refined.nominal_covariance());
    }
  }
  /// Scans see no shift of all walls: of its variance, sigma^2 over the walls, none is learned.
  void expect_frame_of_plan() const {
    double along_y = 0;
    double count = 0;
    for (std::size_t k = 0; k < filter_.size(); ++k) {
      for (std::size_t l = 0; l < filter_.size(); ++l) {
        const auto sign = [&](std::size_t slot) {
          const std::size_t index = filter_[slot].wall;
          return index == 0 ? 1 : index == 2 || index == 4 ? -1 : 0;
        };
        along_y += sign(k) * sign(l) * filter_.covariance_m2(k, l);
      }
      count += filter_[k].wall % 2 == 0 ? 1 : 0;
    }
    EXPECT_NEAR(along_y / (count * count), kSigma_m * kSigma_m / count, 1e-5);
  }
  WallOffset wall(std::size_t index) const {
    for (std::size_t k = 0; k < filter_.size(); ++k) {
      if (filter_[k].wall == index) return filter_[k];
    }
    ADD_FAILURE() << "wall " << index << " is not learned";
    return {};
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(drawn());
  std::shared_ptr<const WallMap> building_ = testing::make_map(built());
  WallOffsetFilter filter_{*map_};
  Refinement refinement_{12, {}};
  testing::ScanSource source_{51};
};

TEST_F(WallOffsetFilterTest, Scans_OffsetsRelativeToEachOtherAreLearned) {
  learn(100);
  ASSERT_EQ(filter_.size(), 6u);
  // Wall 0 runs to the right and wall 4 to the left: their offsets have opposite signs.
  EXPECT_NEAR(-wall(4).offset_m - wall(0).offset_m, kOff_m, 0.002);
  EXPECT_NEAR(-wall(2).offset_m - wall(0).offset_m, kOff_m, 0.002);
  EXPECT_NEAR(wall(1).offset_m + wall(5).offset_m, 0, 0.002);
}

TEST_F(WallOffsetFilterTest, TurnedWalls_OfferLessThanWallsThatAreParallel) {
  learn(10);
  const auto sigma_m = [&](double direction_share) {
    filter_.begin(direction_share);
    return filter_.sigma_m(0);
  };
  // Points of a wall whose ends are off by N(0, sigma) scatter about its middle by sigma^2 / 6.
  EXPECT_NEAR(squared(sigma_m(1)) - squared(sigma_m(0)), squared(kSigma_m) / 6, 1e-9);
  EXPECT_NEAR(squared(sigma_m(0.25)) - squared(sigma_m(0)), squared(kSigma_m) / 24, 1e-9);
}

TEST_F(WallOffsetFilterTest, ManyScans_FrameStaysAsUncertainAsThePlan) {
  learn(300);
  expect_frame_of_plan();
}

TEST_F(WallOffsetFilterTest, ManyScansOfTurnedWalls_FrameStaysAsUncertainAsThePlan) {
  learn(300, 1);
  expect_frame_of_plan();
}

TEST_F(WallOffsetFilterTest, LearnedWalls_PosesAreConsistentWithTheFrame) {
  learn(100);
  double nees = 0;
  constexpr int kPoses = 50;
  Vec2 mean = Vec2::Zero();
  for (int k = 0; k < kPoses; ++k) {
    const Pose2 T_map_lidar = source_.place_in(0.4, 2.2, 0.4, 2.6);
    const RefinedPose refined = refine(T_map_lidar);
    ASSERT_TRUE(refined.valid);
    const Eigen::Vector3d error(
        refined.T_map_lidar.x_m - T_map_lidar.x_m, refined.T_map_lidar.y_m - T_map_lidar.y_m,
        angle_between(T_map_lidar.theta_rad, refined.T_map_lidar.theta_rad));
    nees += error.dot(refined.covariance.inverse() * error) / kPoses;
    mean += error.head<2>() / kPoses;
    EXPECT_GT(refined.covariance(1, 1), 0.9 * kSigma_m * kSigma_m / 3);
  }
  EXPECT_LT(nees, 7.8);
  // The walls' mean: two of three are off. What is off as a whole is in each pose.
  EXPECT_NEAR(mean.y(), -kOff_m * 2 / 3, 0.003);
}

TEST_F(WallOffsetFilterTest, ScanOfAnotherPlace_TeachesNothing) {
  learn(50);
  const double before_m = wall(4).offset_m;
  const Pose2 T_map_lidar = source_.place_in(0.4, 2.2, 0.4, 2.6);
  FloorPlan plan = built();
  for (Vec2* end : {&plan.walls[0].from, &plan.walls[0].to}) end->y() += 0.025;
  for (Vec2* end : {&plan.walls[1].from, &plan.walls[1].to}) end->x() -= 0.025;
  const auto other = testing::make_map(plan);
  const PolarScan points = testing::polar(source_.take(*other, T_map_lidar));
  const RefinedPose refined = refinement_.refine(*map_, T_map_lidar, 0.02, points.points(),
                                                 points.points(), 1, kSigma_m, nullptr, &filter_);
  filter_.learn(refined.covariance);
  EXPECT_EQ(wall(4).offset_m, before_m);
}

TEST_F(WallOffsetFilterTest, Resumed_ContinuesWhereItWas) {
  learn(50);
  LearnedWalls learned;
  filter_.copy_to(learned);
  WallOffsetFilter resumed(*map_);
  ASSERT_TRUE(resumed.resume(learned));
  ASSERT_EQ(resumed.size(), filter_.size());
  for (std::size_t k = 0; k < filter_.size(); ++k) {
    EXPECT_EQ(resumed[k].wall, filter_[k].wall);
    EXPECT_EQ(resumed[k].offset_m, filter_[k].offset_m);
    for (std::size_t l = 0; l < filter_.size(); ++l) {
      EXPECT_EQ(resumed.covariance_m2(k, l), filter_.covariance_m2(k, l));
    }
  }
}

TEST_F(WallOffsetFilterTest, ImpossibleState_Refused) {
  learn(20);
  LearnedWalls learned;
  filter_.copy_to(learned);
  WallOffsetFilter resumed(*map_);
  for (int k = 0; k < 4; ++k) {
    LearnedWalls bad = learned;
    if (k == 0) bad.covariance_m2.pop_back();
    if (k == 1) bad.offsets[0].wall = 6;
    if (k == 2) bad.offsets[0].wall = bad.offsets[1].wall;
    if (k == 3) bad.covariance_m2[1] = 1;
    EXPECT_FALSE(resumed.resume(bad)) << k;
  }
  EXPECT_EQ(resumed.size(), 0u);
}

}  // namespace
}  // namespace cornerd::core
