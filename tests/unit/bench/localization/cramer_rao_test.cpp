// SPDX-License-Identifier: MIT
#include "bench/localization/cramer_rao.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/LU>

#include "replay/simulator/scan_simulator.hpp"
#include "tests/unit/replay/test_maps.hpp"

namespace cornerd::bench {
namespace {

core::PolarScan scan_at(const core::WallMap& map, const core::Pose2& place, std::size_t samples) {
  replay::ScanSimulator lidar(replay::SensorModel::perfect(), samples, 1);
  core::PolarScan points;
  points.assign(lidar.take(map, place), 0.1, 12);
  return points;
}

TEST(CramerRao, FourTimesTheSamples_HalfTheBound) {
  const auto map = replay::make_room();
  const core::Pose2 place{1.2, 1.1, 0.4};
  CramerRao cramer_rao({}, 12);
  const core::Covariance3 few = cramer_rao.bound(*map, place, scan_at(*map, place, 400));
  const core::Covariance3 many = cramer_rao.bound(*map, place, scan_at(*map, place, 1600));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::sqrt(few(i, i) / many(i, i)), 2, 0.1);
}

TEST(CramerRao, RangeNoiseAlone_MatchesClosedForm) {
  // Each wall constrains its normal: n rays at angles a to the wall give an information of n *
  // sin^2(a) / (sigma * sin(a))^2 = n / sigma^2.
  const auto map = replay::make_room();
  const core::Pose2 place{1.2, 1.1, 0};
  core::SensorNoise noise;
  noise.floor_m = 0.01;
  noise.share = 0;
  noise.bearing_rad = 0;
  const core::PolarScan scan = scan_at(*map, place, 3600);
  const core::Covariance3 bound = CramerRao(noise, 12).bound(*map, place, scan);
  const core::Covariance3 information = bound.inverse();
  // Opposite walls share the rays: x and y together get one information of n / sigma^2 each.
  const double rays = information(0, 0) + information(1, 1);
  double expected = 0;
  for (const core::PolarPoint& point : scan.points()) {
    const double x_m = place.x_m + point.x_m;
    const double y_m = place.y_m + point.y_m;
    double sine = 0;
    for (const core::Face& face : map->faces()) {
      if (std::abs(face.normal.dot(core::Vec2(x_m, y_m)) - face.offset_m) > 1e-6) continue;
      sine = std::abs(face.normal.dot(point.ray()));
    }
    if (sine > 0) expected += 1 / (noise.floor_m * noise.floor_m * sine * sine);
  }
  EXPECT_NEAR(rays / expected, 1, 0.02);
}

TEST(CramerRao, WallsOff_BoundIsThatOfTheMeanOfOppositeOnes) {
  // Without noise two walls that are each off by sigma place the robot between them to sigma /
  // sqrt(2).
  const auto map = replay::make_room();
  const core::Pose2 place{1.2, 1.1, 0.4};
  constexpr double kSigma_m = 0.03;
  core::SensorNoise noise;
  noise.floor_m = 1e-6;
  noise.share = noise.bearing_rad = 0;
  const core::Covariance3 bound =
      CramerRao(noise, 12, kSigma_m).bound(*map, place, scan_at(*map, place, 1600));
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::sqrt(2 * bound(i, i)) / kSigma_m, 1, 0.02);
}

TEST(CramerRao, SingleWall_NoBound) {
  core::FloorPlan plan;
  plan.walls = {{{-50, 1}, {50, 1}, 0}};
  const core::WallMap map(plan);
  EXPECT_TRUE(CramerRao({}, 12).bound(map, {}, scan_at(map, {}, 400)).isZero());
}

}  // namespace
}  // namespace cornerd::bench
