// SPDX-License-Identifier: MIT
#include "core/geometry/pose2.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cornerd::core {
namespace {

TEST(NormalizeAngle, AnyAngle_IsInHalfOpenInterval) {
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

TEST(NormalizeAngle, HalfRevolutionAfterMany_IsNeverBeyondPi) {
  for (int k = -2000; k <= 2000; ++k) {
    EXPECT_LE(std::abs(normalize_angle(radians(180 + 360 * k))), kPi) << k;
  }
}

TEST(AngleBetween, AcrossSeam_TakesShorterRotation) {
  EXPECT_NEAR(angle_between(radians(170), radians(-170)), radians(20), 1e-12);
  EXPECT_NEAR(angle_between(radians(-170), radians(170)), radians(-20), 1e-12);
}

TEST(Pose2, TimesItsInverse_IsIdentity) {
  for (int k = 0; k < 100; ++k) {
    const Pose2 T_a_b{k * 0.3 - 10, 5 - k * 0.2, normalize_angle(k * 0.7)};
    const Pose2 nothing = T_a_b * T_a_b.inverse();
    EXPECT_NEAR(nothing.x_m, 0, 1e-12);
    EXPECT_NEAR(nothing.y_m, 0, 1e-12);
    EXPECT_NEAR(nothing.theta_rad, 0, 1e-12);
  }
}

TEST(Pose2, Composition_AppliesTransformsInOrder) {
  const Pose2 T_a_b{1, 2, 0.5};
  const Pose2 T_b_c{-0.3, 0.7, -2.9};
  const Vec2 p_c(0.4, -1.1);
  EXPECT_LT(((T_a_b * T_b_c) * p_c - T_a_b * (T_b_c * p_c)).norm(), 1e-12);
}

TEST(Pose2, QuarterRotation_MapsXToY) {
  const Vec2 p = Pose2{0, 0, kPi / 2} * Vec2(1, 0);
  EXPECT_NEAR(p.x(), 0, 1e-15);
  EXPECT_NEAR(p.y(), 1, 1e-15);
}

TEST(Twist2, Over_FollowsTheArc) {
  // A quarter of a circle of 1 m to the left.
  const Pose2 quarter = Twist2{kPi / 2, 0, kPi / 2}.over(1);
  EXPECT_NEAR(quarter.x_m, 1, 1e-12);
  EXPECT_NEAR(quarter.y_m, 1, 1e-12);
  EXPECT_NEAR(quarter.theta_rad, kPi / 2, 1e-12);
}

TEST(Twist2, MotionBetween_InvertsOver) {
  const Pose2 from{0.3, -0.7, 2.9};
  for (const double omega_rad_s : {0.0, 1e-4, 0.0099, 0.011, 1.5, -6.0}) {
    const Twist2 motion{0.5, -0.2, omega_rad_s};
    const Twist2 found = motion_between(from, from * motion.over(0.18), 0.18);
    EXPECT_NEAR(found.vx_m_s, motion.vx_m_s, 1e-8) << omega_rad_s;
    EXPECT_NEAR(found.vy_m_s, motion.vy_m_s, 1e-8) << omega_rad_s;
    EXPECT_NEAR(found.omega_rad_s, motion.omega_rad_s, 1e-9) << omega_rad_s;
  }
}

}  // namespace
}  // namespace cornerd::core
