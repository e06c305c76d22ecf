// SPDX-License-Identifier: MIT
#include "core/geometry/pose2.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cornerd::core {
namespace {

TEST(NormalizeAngle, AnyTurn_LiesAboveMinusPiUpToPi) {
  for (int k = -2000; k <= 2000; ++k) {
    const double angle = k * 0.01;
    const double normal = normalize_angle(angle);
    EXPECT_GT(normal, -kPi);
    EXPECT_LE(normal, kPi);
    EXPECT_NEAR(std::remainder(angle - normal, kTwoPi), 0, 1e-12);
  }
}

TEST(NormalizeAngle, MinusPi_IsPi) {
  EXPECT_EQ(normalize_angle(-kPi), kPi);
  EXPECT_EQ(normalize_angle(kPi), kPi);
  EXPECT_NEAR(normalize_angle(3 * kPi), kPi, 1e-12);
}

TEST(AngleBetween, AcrossTheSeam_TakesTheShorterWay) {
  EXPECT_NEAR(angle_between(radians(170), radians(-170)), radians(20), 1e-12);
  EXPECT_NEAR(angle_between(radians(-170), radians(170)), radians(-20), 1e-12);
}

TEST(Pose2, TimesItsInverse_IsNothing) {
  for (int k = 0; k < 100; ++k) {
    const Pose2 T_a_b{k * 0.3 - 10, 5 - k * 0.2, normalize_angle(k * 0.7)};
    const Pose2 nothing = T_a_b * T_a_b.inverse();
    EXPECT_NEAR(nothing.x_m, 0, 1e-12);
    EXPECT_NEAR(nothing.y_m, 0, 1e-12);
    EXPECT_NEAR(nothing.theta_rad, 0, 1e-12);
  }
}

TEST(Pose2, Composition_MovesPointsOneAfterTheOther) {
  const Pose2 T_a_b{1, 2, 0.5};
  const Pose2 T_b_c{-0.3, 0.7, -2.9};
  const Vec2 p_c(0.4, -1.1);
  EXPECT_LT(((T_a_b * T_b_c) * p_c - T_a_b * (T_b_c * p_c)).norm(), 1e-12);
}

TEST(Pose2, QuarterTurn_TakesXToY) {
  const Vec2 p = Pose2{0, 0, kPi / 2} * Vec2(1, 0);
  EXPECT_NEAR(p.x(), 0, 1e-15);
  EXPECT_NEAR(p.y(), 1, 1e-15);
}

}  // namespace
}  // namespace cornerd::core
