// SPDX-License-Identifier: MIT
#include "core/estimate/point_lanes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cornerd::core {
namespace {

constexpr std::size_t kWallPoints = 37;
const double kWallAngle_rad = 0.4;
const double kHeight_m = 1.7;
const double kScale = 1.3;

/// Returns of a wall whose nearest point lies behind the lidar, some of them outliers.
PolarScan noisy_wall() {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  PolarScan scan;
  scan.begin(0.03);
  for (std::size_t i = 0; i < kWallPoints; ++i) {
    const double from_normal_rad = -0.9 + 0.05 * static_cast<double>(i);
    const double off_m = i % 9 == 4 ? 0.2 : 0.003 * normal(random);
    scan.append(kWallAngle_rad + kPi + from_normal_rad,
                (kHeight_m + off_m) / std::cos(from_normal_rad));
  }
  return scan;
}

/// Point by point in double precision.
FaceSums exact_sum(std::span<const PolarPoint> points, const SensorNoise& noise,
                   double extra_sigma_m) {
  const Vec2 normal = unit_vector(kWallAngle_rad);
  FaceSums sum;
  for (const PolarPoint& point : points) {
    const double distance_m = normal.dot(point.position()) + kHeight_m;
    const double lever_m = normal.y() * point.x_m - normal.x() * point.y_m;
    const double variance =
        noise.variance_across_m2(point.range_m, std::abs(normal.dot(point.ray()))) * kScale *
            kScale +
        extra_sigma_m * extra_sigma_m;
    const double z_squared = distance_m * distance_m / variance;
    if (z_squared >= 16) continue;
    const double share = 1 - z_squared / 16;
    const double weight = share * share / variance;
    sum.weight += weight;
    sum.lever += weight * lever_m;
    sum.lever_squared += weight * lever_m * lever_m;
    sum.distance += weight * distance_m;
    sum.distance_lever += weight * distance_m * lever_m;
    sum.z_squared += z_squared;
    sum.squared_distances += distance_m * distance_m;
    sum.points += 1;
  }
  return sum;
}

void expect_near(const FaceSums& one, const FaceSums& other) {
  constexpr double kShare = 1e-3;  // NEON divides approximately
  EXPECT_NEAR(one.weight, other.weight, kShare * other.weight);
  EXPECT_NEAR(one.lever, other.lever, kShare * other.weight);
  EXPECT_NEAR(one.lever_squared, other.lever_squared, kShare * other.lever_squared);
  EXPECT_NEAR(one.distance, other.distance, 1e-6 * other.weight);
  EXPECT_NEAR(one.distance_lever, other.distance_lever, 2e-6 * other.weight);
  EXPECT_NEAR(one.z_squared, other.z_squared, kShare * other.z_squared);
  EXPECT_NEAR(one.squared_distances, other.squared_distances, kShare * other.squared_distances);
  EXPECT_EQ(one.points, other.points);
}

TEST(PointLanes, PointsOfWall_SumsMatchDoublePrecision) {
  const PolarScan scan = noisy_wall();
  SensorNoise by_table;
  const SigmaTable::Point measured[] = {{1, 0.002}, {3, 0.009}};
  by_table.table = SigmaTable(measured);
  PointLanes lanes;
  for (const SensorNoise& noise : {SensorNoise{}, by_table}) {
    lanes.assign(scan.points(), noise, kScale);
    for (const double extra_sigma_m : {0.0, 0.01}) {
      // Every remainder of the groups of four.
      for (std::size_t begin = 0; begin < 5; ++begin) {
        const auto part = scan.points().subspan(begin);
        expect_near(
            lanes.sum(begin, scan.size(), unit_vector(kWallAngle_rad), kHeight_m, extra_sigma_m),
            exact_sum(part, noise, extra_sigma_m));
      }
    }
  }
}

TEST(PointLanes, NoPoints_SumsAreZero) {
  PointLanes lanes;
  lanes.assign({}, {}, 1);
  EXPECT_EQ(lanes.sum(0, 0, {1, 0}, 1, 0).points, 0);
}

TEST(PointLanes, NoiselessPointsOnWall_WeightIsFinite) {
  PolarScan scan;
  scan.begin(0.1);
  scan.append(kPi, 2);
  PointLanes lanes;
  lanes.assign(scan.points(), {0, 0, 0}, 1);
  const FaceSums sum = lanes.sum(0, 1, {1, 0}, 2, 0);
  EXPECT_TRUE(std::isfinite(sum.weight));
  EXPECT_GT(sum.weight, 0);
}

TEST(PointLanes, TurnedPlane_MovedBackIsTheFaceAgain) {
  // So wide that all weights are alike.
  constexpr double kExtra_m = 30;
  constexpr double kAngle_rad = 0.4;
  const PolarScan scan = noisy_wall();
  PointLanes lanes;
  lanes.assign(scan.points(), SensorNoise{}, kScale);
  const Vec2 normal = unit_vector(kWallAngle_rad);
  const FaceSums face = lanes.sum(0, kWallPoints, normal, kHeight_m, kExtra_m);
  FaceSums turned = lanes.sum(0, kWallPoints, normal, kHeight_m - 0.2 + kAngle_rad * 0.3, kExtra_m,
                              0, kAngle_rad);
  EXPECT_NEAR(turned.lever, face.lever, 0.01 * face.weight);
  EXPECT_NEAR(turned.distance,
              face.distance - 0.2 * face.weight - kAngle_rad * (face.lever - 0.3 * face.weight),
              0.01 * face.weight);
  turned.move(0.2, kAngle_rad, 0.3);
  EXPECT_NEAR(turned.distance, face.distance, 0.01 * face.weight);
  EXPECT_NEAR(turned.distance_lever, face.distance_lever, 0.01 * face.weight);
  EXPECT_NEAR(turned.z_squared, face.z_squared, 0.01 * face.weight);
}

}  // namespace
}  // namespace cornerd::core
