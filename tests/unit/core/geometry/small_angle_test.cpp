// SPDX-License-Identifier: MIT
#include "core/geometry/small_angle.hpp"

#include <gtest/gtest.h>

namespace cornerd::core {
namespace {

const double kAngles_rad[] = {0, 1e-9, 1e-3, 0.02, 0.0999, 0.1, 0.1001, 0.5, 2, 3.1};

TEST(SmallAngle, Rotated_MatchesSineAndCosine) {
  const Vec2 way(0.6, -2.5);
  for (const double size_rad : kAngles_rad) {
    for (const double angle_rad : {size_rad, -size_rad}) {
      const Vec2 exact(std::cos(angle_rad) * way.x() - std::sin(angle_rad) * way.y(),
                       std::sin(angle_rad) * way.x() + std::cos(angle_rad) * way.y());
      EXPECT_LT((rotated(way, angle_rad) - exact).norm(), 6e-11) << angle_rad;
    }
  }
}

TEST(SmallAngle, RotationBetween_MatchesArcTangent) {
  const Vec2 from(-1.2, 0.3);
  for (const double size_rad : kAngles_rad) {
    for (const double angle_rad : {size_rad, -size_rad}) {
      const Vec2 to(3 * (std::cos(angle_rad) * from.x() - std::sin(angle_rad) * from.y()),
                    3 * (std::sin(angle_rad) * from.x() + std::cos(angle_rad) * from.y()));
      EXPECT_NEAR(rotation_between(from, to), angle_rad, 2e-12);
    }
  }
}

TEST(SmallAngle, RotationBetweenOppositeDirections_IsPi) {
  EXPECT_DOUBLE_EQ(std::abs(rotation_between({1, 0}, {-2, 0})), kPi);
}

}  // namespace
}  // namespace cornerd::core
