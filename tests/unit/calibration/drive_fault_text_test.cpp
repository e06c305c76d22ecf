// SPDX-License-Identifier: MIT
#include "calibration/drive_fault_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cornerd::calibration {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string described(const DriveHypothesis& one, bool is_kernel = false) {
  DriveFaults faults;
  faults.drive = {one};
  return describe(faults, {.is_kernel = is_kernel});
}
std::string described(const GyroHypothesis& one, bool is_kernel = false) {
  DriveFaults faults;
  faults.gyro = {one};
  return describe(faults, {.is_kernel = is_kernel});
}

TEST(DriveFaultText, NoFault_GivesNoText) { EXPECT_EQ(describe({}, {}), ""); }

TEST(DriveFaultText, WrongFactor_GivesCorrectedValue) {
  const auto by = [](double factor) {
    return described({.fault = DriveFault::kCounts, .factor = factor});
  };
  EXPECT_EQ(by(4.08),
            "the wheels move 4.08 times as far as their counts: set odometry.counts_per_turn to "
            "360");
  EXPECT_THAT(by(0.26), HasSubstr("odometry.counts_per_turn to 5760"));
  EXPECT_THAT(by(0.51), HasSubstr("odometry.counts_per_turn to 2880 or odometry.wheel_radius to "
                                  "0.01625"));
  EXPECT_THAT(by(1.6), HasSubstr("odometry.counts_per_turn to 900 or odometry.wheel_radius to "
                                 "0.052"));
}

TEST(DriveFaultText, OdometrySource_SelectsTheRemedy) {
  const DriveHypothesis swapped{.fault = DriveFault::kWiring, .wiring = {true, false, false}};
  const GyroHypothesis reversed{.fault = GyroFault::kReversed};
  EXPECT_THAT(described(swapped), HasSubstr("swap left and right in the ODOMETRY lines"));
  EXPECT_THAT(described(reversed), HasSubstr("negate gyro in the ODOMETRY lines"));
  EXPECT_THAT(described(swapped, true),
              HasSubstr("swap advanced.odometry.kernel.left and advanced.odometry.kernel.right"));
  EXPECT_THAT(described(reversed, true),
              HasSubstr("set advanced.odometry.kernel.gyro.reversed to true"));
}

TEST(DriveFaultText, WhatCannotBeToldApart_IsAllSaid) {
  DriveFaults faults;
  faults.drive = {{.fault = DriveFault::kMountTurned, .T_base_lidar = {0, 0, core::kPi}},
                  {.fault = DriveFault::kWiring, .wiring = {true, true, true}}};
  faults.gyro = {{.fault = GyroFault::kDegrees}};
  EXPECT_EQ(
      describe(faults, {}),
      "either the lidar looks 180 degrees off what lidar.mount says: set lidar.mount.theta to "
      "3.1416, or left and right are exchanged: swap left and right in the ODOMETRY lines; "
      "both wheels count backward: negate left in the ODOMETRY lines and negate right in the "
      "ODOMETRY lines; the gyro is in degrees a second: send radians a second");
}

TEST(DriveFaultText, Factor_IsNoUnit) {
  EXPECT_THAT(described(GyroHypothesis{.fault = GyroFault::kFactor, .factor = 3}),
              Not(HasSubstr("degrees")));
}

}  // namespace
}  // namespace cornerd::calibration
