// SPDX-License-Identifier: MIT
#include "core/estimate/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

class RefinementTest : public ::testing::Test {
 protected:
  RefinedPose refine(const Scan& scan, const Pose2& start, double search_radius_m = 0.1) {
    const PolarScan points = testing::polar(scan);
    std::vector<PolarPoint> subset;
    for (std::size_t i = 0; i < points.size(); i += 6) subset.push_back(points[i]);
    return refinement_.refine(*map_, start, search_radius_m, subset, points.points(), 1);
  }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  Refinement refinement_{12, {}};
  testing::ScanSource source_{51};
};

TEST_F(RefinementTest, NoiselessScan_PoseIsExact) {
  testing::ScanOptions options;
  options.with_noise = false;
  const Pose2 T_map_lidar{1.2, 0.9, 0.7};
  const RefinedPose refined = refine(source_.take(*map_, T_map_lidar, options), {1.25, 0.85, 0.75});
  ASSERT_TRUE(refined.valid);
  EXPECT_NEAR(refined.T_map_lidar.x_m, 1.2, 1e-5);
  EXPECT_NEAR(refined.T_map_lidar.y_m, 0.9, 1e-5);
  EXPECT_NEAR(refined.T_map_lidar.theta_rad, 0.7, 1e-5);
}

TEST_F(RefinementTest, DisplacedWalls_OffsetsAreMarginalised) {
  constexpr double kOff_m = 0.02;
  FloorPlan plan = testing::l_shaped_room();
  for (Wall& wall : plan.walls) {
    for (Vec2* end : {&wall.from, &wall.to}) end->y() += end->y() > 1.5 ? kOff_m : 0;
  }
  const auto building = testing::make_map(plan);
  const Pose2 T_map_lidar{1.2, 0.9, 0.7};
  const PolarScan points = testing::polar(source_.take(*building, T_map_lidar));
  const auto error_of = [&](double map_sigma_m) {
    const RefinedPose refined = refinement_.refine(*map_, T_map_lidar, 0.1, points.points(),
                                                   points.points(), 1, map_sigma_m);
    EXPECT_TRUE(refined.valid);
    const Eigen::Vector3d error(refined.T_map_lidar.x_m - T_map_lidar.x_m,
                                refined.T_map_lidar.y_m - T_map_lidar.y_m,
                                refined.T_map_lidar.theta_rad - T_map_lidar.theta_rad);
    return error.dot(refined.covariance.inverse() * error);
  };
  EXPECT_LT(error_of(kOff_m), 7.8);  // 95 % of a chi-square of three
  EXPECT_GT(error_of(0), error_of(kOff_m));
}

TEST_F(RefinementTest, TurnedWalls_DirectionsAreMarginalised) {
  constexpr double kOff_m = 0.01;
  constexpr int kBuildings = 60;
  double nees_parallel = 0;
  double nees = 0;
  double error_parallel_rad = 0;
  double error_rad = 0;
  for (int seed = 1; seed <= kBuildings; ++seed) {
    FloorPlan plan = testing::l_shaped_room();
    for (Wall& wall : plan.walls) {
      for (Vec2* end : {&wall.from, &wall.to}) {
        *end += kOff_m * Vec2(source_.normal(), source_.normal());
      }
    }
    const auto building = testing::make_map(plan);
    const Pose2 T_map_lidar = source_.place_in(0.5, 2.2, 0.4, 1.5);
    const PolarScan points = testing::polar(source_.take(*building, T_map_lidar));
    const RefinedPose parallel =
        refinement_.refine(*map_, T_map_lidar, 0.05, points.points(), points.points(), 1, kOff_m);
    ASSERT_TRUE(parallel.valid);
    const RefinedPose turned =
        parallel.shows_directions()
            ? refinement_.refine_directions(*map_, parallel, points.points(), 1, kOff_m)
            : parallel;
    ASSERT_TRUE(turned.valid);
    const auto error_of = [&](const RefinedPose& refined) -> Eigen::Vector3d {
      return {refined.T_map_lidar.x_m - T_map_lidar.x_m, refined.T_map_lidar.y_m - T_map_lidar.y_m,
              angle_between(T_map_lidar.theta_rad, refined.T_map_lidar.theta_rad)};
    };
    const auto nees_of = [&](const RefinedPose& refined) {
      const Eigen::Vector3d error = error_of(refined);
      return error.dot(refined.covariance.inverse() * error);
    };
    nees_parallel += nees_of(parallel) / kBuildings;
    nees += nees_of(turned) / kBuildings;
    error_parallel_rad += std::abs(error_of(parallel).z()) / kBuildings;
    error_rad += std::abs(error_of(turned).z()) / kBuildings;
  }
  EXPECT_LT(nees, 5);
  EXPECT_GT(nees_parallel, 5);
  EXPECT_LT(error_rad, error_parallel_rad);
}

TEST_F(RefinementTest, WallsOff_HowFarIsEstimated_AndTheHeadingIsOfTheirDirections) {
  constexpr int kBuildings = 40;
  for (const double sigma_m : {0.005, 0.03}) {
    double square_m2 = 0;
    double error_rad = 0;
    double nees = 0;
    for (std::uint64_t seed = 1; seed <= kBuildings; ++seed) {
      const auto building =
          testing::make_map(testing::with_walls_off(testing::l_shaped_room(), sigma_m, seed));
      const Pose2 truth = source_.place_in(0.5, 2.2, 0.4, 1.5);
      const PolarScan points = testing::polar(source_.take(*building, truth));
      const RefinedPose refined =
          refinement_.refine(*map_, truth, 0.02, points.points(), points.points(), 1, 0.01);
      ASSERT_TRUE(refined.valid);
      square_m2 += refined.map_sigma_m * refined.map_sigma_m / kBuildings;
      const Eigen::Vector3d error(refined.T_map_lidar.x_m - truth.x_m,
                                  refined.T_map_lidar.y_m - truth.y_m,
                                  angle_between(truth.theta_rad, refined.T_map_lidar.theta_rad));
      error_rad += std::abs(error.z()) / kBuildings;
      nees += error.dot(refined.covariance.inverse() * error) / kBuildings;
    }
    // The prior of 1 cm counts as much as two of six walls, of which the pose takes three.
    EXPECT_GT(std::sqrt(square_m2), sigma_m / 2);
    EXPECT_LT(std::sqrt(square_m2), sigma_m < 0.01 ? 0.01 : sigma_m * 1.3);
    EXPECT_LT(error_rad, radians(0.06));  // half a degree where walls are taken for exact
    EXPECT_LT(nees, 9);                   // one scan of a prior that is three times too sure
    EXPECT_GT(nees, 0.5);
  }
}

TEST_F(RefinementTest, OneLineInTwoWalls_CovarianceIsOfOneOffset) {
  // The same two planes, as one wall and in two pieces beside a gap: offsets of a line are common.
  FloorPlan plan = testing::l_shaped_room();
  const Wall first = plan.walls.front();
  const Vec2 middle = (first.from + first.to) / 2;
  const Vec2 gap = 0.02 * (first.to - first.from).normalized();
  plan.walls.front().to = middle - gap;
  plan.walls.push_back({middle + gap, first.to, first.thickness_m});
  const auto in_two = testing::make_map(plan);
  const Pose2 truth{1.2, 0.9, 0.7};
  const PolarScan points = testing::polar(source_.take(*map_, truth));
  const auto variance_of = [&](const WallMap& map) {
    const RefinedPose refined =
        refinement_.refine(map, truth, 0.02, points.points(), points.points(), 1, 0.01);
    EXPECT_TRUE(refined.valid);
    return refined.covariance.topLeftCorner<2, 2>().trace() / std::pow(refined.map_sigma_m, 2);
  };
  EXPECT_NEAR(variance_of(*in_two) / variance_of(*map_), 1, 0.25);
}

TEST_F(RefinementTest, AcceleratedRotation_IsFound) {
  testing::ScanOptions options;
  options.with_noise = false;
  options.motion = {Twist2{0.1, -0.05, 1.5}, 6};
  const Pose2 T_map_lidar{1.2, 0.9, 0.7};
  const Scan scan = source_.take(*map_, T_map_lidar, options);
  PolarScan points;
  points.assign(scan, 0.05, 12, from_seconds(options.scan_s / 2), Twist2{0, 0, 1});
  const RefinedMotion refined =
      refinement_.refine_motion(*map_, T_map_lidar, 0.08, points.points(), 1, true);
  ASSERT_TRUE(refined.valid);
  EXPECT_NEAR(refined.motion.twist.vx_m_s, 0.1, 0.01);
  EXPECT_NEAR(refined.motion.twist.vy_m_s, -0.05, 0.01);
  EXPECT_NEAR(refined.motion.twist.omega_rad_s, 0.5, 0.01);
  EXPECT_NEAR(refined.motion.alpha_rad_s2, 6, 0.2);
  EXPECT_NEAR(refined.T_map_lidar.theta_rad, 0.7, 5e-4);
}

TEST_F(RefinementTest, PoseOfAScanNotDeskewed_IsOffAsItsDerivativeSays) {
  testing::ScanOptions options;
  options.with_noise = false;
  const Pose2 T_map_lidar{1.2, 0.9, 0.7};
  for (const Twist2& motion : {Twist2{0.05, 0, 0}, Twist2{0, 0.05, 0}, Twist2{0, 0, 0.02}}) {
    options.motion = motion;
    const Scan scan = source_.take(*map_, T_map_lidar, options);
    PolarScan points;
    points.assign(scan, 0.05, 12, from_seconds(options.scan_s / 2));
    const RefinedPose refined =
        refinement_.refine(*map_, T_map_lidar, 0.02, points.points(), points.points(), 1);
    ASSERT_TRUE(refined.valid);
    const Eigen::Vector3d expected =
        refinement_.error_per_velocity(*map_, T_map_lidar, points.points(), 1) *
        Eigen::Vector3d(motion.vx_m_s, motion.vy_m_s, motion.omega_rad_s);
    const Eigen::Vector3d error(refined.T_map_lidar.x_m - T_map_lidar.x_m,
                                refined.T_map_lidar.y_m - T_map_lidar.y_m,
                                refined.T_map_lidar.theta_rad - T_map_lidar.theta_rad);
    EXPECT_GT(error.norm(), 2e-4);
    EXPECT_LT((error - expected).norm(), 0.15 * error.norm()) << error << expected;
  }
}

TEST_F(RefinementTest, NoisyScans_CovarianceIsConsistent) {
  double nees = 0;
  int count = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose2 T_map_lidar = source_.place_in(0.5, 2.2, 0.4, 1.5);
    const Pose2 start = T_map_lidar * Pose2{0.03, -0.03, 0.03};
    const RefinedPose refined = refine(source_.take(*map_, T_map_lidar), start);
    ASSERT_TRUE(refined.valid);
    const Eigen::Vector3d error(
        refined.T_map_lidar.x_m - T_map_lidar.x_m, refined.T_map_lidar.y_m - T_map_lidar.y_m,
        angle_between(T_map_lidar.theta_rad, refined.T_map_lidar.theta_rad));
    EXPECT_LT(error.head<2>().norm(), 0.005);
    nees += error.dot(refined.covariance.inverse() * error);
    ++count;
  }
  EXPECT_GT(nees / count, 2.5);  // 3 where it is consistent
  EXPECT_LT(nees / count, 4.0);
}

TEST_F(RefinementTest, SingleWall_PoseIsInvalid) {
  FloorPlan plan;
  plan.walls.push_back({{-5, 1}, {5, 1}, 0.02});
  map_ = testing::make_map(plan);
  EXPECT_FALSE(refine(source_.take(*map_, {0, 0, 0}), {0.02, 0.02, 0.01}).valid);
}

TEST_F(RefinementTest, NoPoints_PoseIsInvalid) { EXPECT_FALSE(refine(Scan(), {1, 1, 0}).valid); }

TEST_F(RefinementTest, ThirdOfRaysBlocked_PoseIsUnchanged) {
  const Pose2 T_map_lidar{1.2, 0.9, 0.7};
  const Scan clear = source_.take(*map_, T_map_lidar);
  Scan scan;
  for (std::size_t i = 0; i < clear.size(); ++i) {
    Sample sample = clear.samples()[i];
    if (i % 180 < 60) sample.range_m *= 0.6F;
    scan.add(sample);
  }
  const RefinedPose refined = refine(scan, T_map_lidar * Pose2{0.04, 0.02, -0.03});
  ASSERT_TRUE(refined.valid);
  EXPECT_LT((refined.T_map_lidar.translation() - T_map_lidar.translation()).norm(), 0.003);
}

}  // namespace
}  // namespace cornerd::core
