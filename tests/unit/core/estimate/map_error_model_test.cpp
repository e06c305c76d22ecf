// SPDX-License-Identifier: MIT
#include "core/estimate/map_error_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "../fixtures.hpp"
#include "core/estimate/refinement.hpp"

namespace cornerd::core {
namespace {

class MapErrorModelTest : public ::testing::Test {
 protected:
  /// Scans in a room whose walls are displaced from the map by this standard deviation, across
  /// themselves.
  void take_turns(double sigma_m, std::uint64_t seed, int scans = 40) {
    const auto building =
        testing::make_map(testing::with_walls_off(testing::l_shaped_room(), sigma_m, seed));
    for (int scan = 0; scan < scans; ++scan) {
      const Pose2 T_map_lidar = source_.place_in(0.5, 2.2, 0.4, 1.5);
      const PolarScan points = testing::polar(source_.take(*building, T_map_lidar));
      const RefinedPose refined =
          refinement_.refine(*map_, T_map_lidar, 0.05, points.points(), points.points(), 1);
      ASSERT_TRUE(refined.valid);
      map_error_.add(refined.face_residuals);
      const Eigen::Vector3d error(
          refined.T_map_lidar.x_m - T_map_lidar.x_m, refined.T_map_lidar.y_m - T_map_lidar.y_m,
          angle_between(T_map_lidar.theta_rad, refined.T_map_lidar.theta_rad));
      const Covariance3 consistent =
          refined.covariance + map_error_.pose_covariance(refined.face_residuals);
      nees_with_ += error.dot(consistent.inverse() * error);
      nees_without_ += error.dot(refined.covariance.inverse() * error);
      variance_m2_ += map_error_.variance_m2();
      ++count_;
    }
    map_error_.forget();
  }
  double sigma_m() const { return std::sqrt(variance_m2_ / count_); }

  std::shared_ptr<const WallMap> map_ = testing::make_map(testing::l_shaped_room());
  Refinement refinement_{12, {}};
  testing::ScanSource source_{8};
  MapErrorModel map_error_;
  double nees_with_ = 0;
  double nees_without_ = 0;
  double variance_m2_ = 0;
  int count_ = 0;
};

TEST_F(MapErrorModelTest, ExactMap_VarianceIsHardlyAny) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) take_turns(0, seed);
  EXPECT_LT(sigma_m(), 0.0006);
  EXPECT_GT(nees_with_ / count_, 2);  // 3 where no scan might be of a map that fits by chance
}

TEST_F(MapErrorModelTest, OneScanOfWallsOffByACentimetre_IsConsistentAlthoughItMayFitByChance) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) take_turns(0.01, seed, /*scans=*/1);
  EXPECT_LT(nees_with_ / count_, 6);
}

TEST_F(MapErrorModelTest, DisplacedWalls_PoseCovarianceIsConsistent) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) take_turns(0.004, seed);
  EXPECT_NEAR(sigma_m(), 0.004, 0.0015);
  EXPECT_LT(nees_with_ / count_, 6);
  EXPECT_GT(nees_without_ / count_, 20);
}

TEST_F(MapErrorModelTest, EmptyScan_AddsNothing) {
  const FaceResidualStatistics nothing = face_residual_statistics({}, Covariance3::Identity());
  map_error_.add(nothing);
  EXPECT_EQ(map_error_.variance_m2(), 0);
  EXPECT_TRUE(map_error_.pose_covariance(nothing).isZero());
}

}  // namespace
}  // namespace cornerd::core
