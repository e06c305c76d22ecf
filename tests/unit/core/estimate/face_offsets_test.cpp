// SPDX-License-Identifier: MIT
#include "core/estimate/face_offsets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../fixtures.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

TEST(FaceOffsets, MergeByLine_BothSidesOfWallsInALineMoveTogether) {
  const auto map = testing::make_map(testing::two_equal_rooms());
  constexpr double kMoved_m = 0.01;
  std::vector<FaceResidual> residuals;
  for (std::uint32_t i = 0; i < map->faces().size(); ++i) {
    const Vec2& normal = map->faces()[i].normal;
    residuals.push_back({{1, 0, 0, kMoved_m * (normal.x() + normal.y()), 0}, i, normal});
  }
  merge_by_line(residuals, *map);
  // x 0, 1, 3, 5, 6, 8; y 0, 2, and the ends of the walls inside at 0.7.
  EXPECT_EQ(residuals.size(), 9U);
  double faces = 0;
  for (const FaceResidual& line : residuals) {
    EXPECT_NEAR(std::abs(line.distance), kMoved_m * line.weight, 1e-9);
    faces += line.weight;
  }
  EXPECT_EQ(faces, static_cast<double>(map->faces().size()));
}

TEST(FaceOffsets, MergeByLine_OfFacesThatAreNotQuiteParallel_KeepsTheSumOfTheirGradients) {
  FloorPlan plan;
  plan.walls = {{{0, 0}, {2, 0}, 0.1}, {{2.2, 0}, {4, 0.05}, 0.1}};
  const auto map = testing::make_map(plan);
  std::vector<FaceResidual> residuals;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::uint32_t i = 0; i < map->faces().size(); ++i) {
    const Vec2& normal = map->faces()[i].normal;
    if (normal.y() < 0.9) continue;
    residuals.push_back({{1e6 * (i + 1), 4e5, 1e6, 0, 0}, i, normal});
    sum += residuals.back().gradient();
  }
  ASSERT_EQ(residuals.size(), 2U);
  merge_by_line(residuals, *map);
  ASSERT_EQ(residuals.size(), 1U);
  EXPECT_LT((residuals.front().gradient() - sum).norm(), 1e-6 * sum.norm());
}

/// Residuals of six walls of 2 m that are turned by N(0, sigma_rad), each seen to 0.05 degrees from
/// a pose whose heading is off, and their normal equations.
struct TurnedWalls {
  TurnedWalls(double sigma_rad, std::uint64_t seed) {
    testing::ScanSource random(seed);
    for (std::uint32_t i = 0; i < 6; ++i) {
      const double weight = 1 / squared(radians(0.05));
      const double turned_rad = sigma_rad * random.normal() + radians(0.05) * random.normal();
      FaceResidual face{{1e6, 0, weight, 0, weight * (turned_rad + 0.01)}, i, unit_vector(i), 2};
      information += face.gradient() * face.gradient().transpose() / face.weight;
      information(2, 2) += face.lever_squared;
      gradient.z() += face.distance_lever;
      residuals.push_back(face);
    }
  }
  double share(double sigma_m) const {
    return shown_direction_share(residuals, *map, sigma_m, information, gradient);
  }

  std::shared_ptr<const WallMap> map = testing::make_map(testing::two_equal_rooms());
  std::vector<FaceResidual> residuals;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

TEST(FaceOffsets, ShownDirectionShare_IsThatOfTheWalls) {
  constexpr double kSigma_m = 0.01;
  constexpr int kScans = 200;
  const double by_ends_rad = std::sqrt(direction_variance(2, kSigma_m));
  double before = -1;
  double sum = 0;
  double sum_of_shown = 0;
  for (const double share : {0.0, 1 / 64.0, 1 / 16.0, 1 / 4.0, 1.0}) {
    double shown = 0;
    for (std::uint64_t seed = 1; seed <= kScans; ++seed) {
      shown += TurnedWalls(std::sqrt(share) * by_ends_rad, seed).share(kSigma_m) / kScans;
    }
    EXPECT_GT(shown, before) << share;
    before = shown;
    sum += share;
    sum_of_shown += shown;
    if (share == 0) {
      EXPECT_LT(shown, 1 / 64.0);  // less than the least that is told from it
    }
  }
  // Over all that the prior allows, the mean of a posterior mean is that of the prior.
  EXPECT_NEAR(sum_of_shown, sum, 0.1);
}

}  // namespace
}  // namespace cornerd::core
