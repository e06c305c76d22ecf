// SPDX-License-Identifier: MIT
#include "core/odometry/gyro_proof.hpp"

#include <gtest/gtest.h>

namespace cornerd::core {
namespace {

/// Scans of 0.14 s at 1 rad/s, of which the gyro measures `gain` times as much.
void rotate(GyroProof& proof, double& heading_rad, double gain, int scans = 1) {
  for (int i = 0; i < scans; ++i) {
    heading_rad = normalize_angle(heading_rad + 0.14);
    OdometryIncrement step;
    step.to_ns = 140'000'000;
    step.gyro_rad = gain * 0.14;
    step.has_gyro = true;
    proof.drove(step);
    proof.fixed(heading_rad);
  }
}

TEST(GyroProof, RotationsSeenByLidar_Validate) {
  GyroProof proof;
  double heading_rad = 0;
  EXPECT_FALSE(proof.holds());
  rotate(proof, heading_rad, 1.03, 4);
  EXPECT_TRUE(proof.holds());
  rotate(proof, heading_rad, -1, 4);
  EXPECT_FALSE(proof.holds());
}

TEST(GyroProof, Straights_DoNotValidate) {
  GyroProof proof;
  double heading_rad = 0;
  for (int i = 0; i < 100; ++i) {
    OdometryIncrement step;
    step.to_ns = 140'000'000;
    step.has_gyro = true;
    proof.drove(step);
    proof.fixed(heading_rad);
  }
  EXPECT_FALSE(proof.holds());
}

TEST(GyroProof, IncrementWithoutGyro_IsIgnored) {
  GyroProof proof;
  double heading_rad = 0;
  rotate(proof, heading_rad, 1, 4);
  OdometryIncrement blind;
  blind.to_ns = 140'000'000;
  for (int i = 0; i < 20; ++i) {
    proof.drove(blind);
    heading_rad = normalize_angle(heading_rad + 1);
    proof.fixed(heading_rad);
  }
  EXPECT_TRUE(proof.holds());
}

}  // namespace
}  // namespace cornerd::core
