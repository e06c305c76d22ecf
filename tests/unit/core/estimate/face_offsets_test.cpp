// SPDX-License-Identifier: MIT
#include "core/estimate/face_offsets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../fixtures.hpp"

namespace cornerd::core {
namespace {

TEST(FaceOffsets, MergeByLine_BothSidesOfWallsInALineMoveTogether) {
  const auto map = testing::make_map(testing::two_equal_rooms());
  constexpr double kMoved_m = 0.01;
  std::vector<FaceResidual> residuals;
  for (std::uint32_t i = 0; i < map->faces().size(); ++i) {
    const Vec2& normal = map->faces()[i].normal;
    residuals.push_back({i, normal, 1, 0, kMoved_m * (normal.x() + normal.y())});
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
    residuals.push_back({i, normal, 1e6 * (i + 1), 4e5, 0});
    sum += residuals.back().gradient();
  }
  ASSERT_EQ(residuals.size(), 2U);
  merge_by_line(residuals, *map);
  ASSERT_EQ(residuals.size(), 1U);
  EXPECT_LT((residuals.front().gradient() - sum).norm(), 1e-6 * sum.norm());
}

}  // namespace
}  // namespace cornerd::core
