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

}  // namespace
}  // namespace cornerd::core
