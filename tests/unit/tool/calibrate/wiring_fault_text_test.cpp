// SPDX-License-Identifier: MIT
#include "tool/calibrate/wiring_fault_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

using calibration::WiringFaults;
using testing::HasSubstr;
using testing::Not;

std::string described(const WiringFaults& faults, settings::OdometrySource source = {}) {
  settings::OdometryConfig config;
  config.source = source;
  return describe_faults(faults, config);
}

TEST(WiringFaultText, NoFault_GivesNoText) { EXPECT_EQ(described({}), ""); }

TEST(WiringFaultText, WrongFactor_GivesCorrectedValue) {
  const auto by = [](double factor) {
    WiringFaults faults;
    faults.left_factor = faults.right_factor = factor;
    return described(faults);
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

TEST(WiringFaultText, OdometrySource_SelectsTheRemedy) {
  WiringFaults faults;
  faults.are_swapped = faults.gyro_is_reversed = true;
  EXPECT_THAT(described(faults), HasSubstr("swap left and right in the ODOMETRY lines; "));
  EXPECT_THAT(described(faults), HasSubstr("negate gyro in the ODOMETRY lines"));
  const std::string kernel = described(faults, settings::OdometrySource::kKernel);
  EXPECT_THAT(kernel,
              HasSubstr("swap advanced.odometry.kernel.left and advanced.odometry.kernel.right"));
  EXPECT_THAT(kernel, HasSubstr("set advanced.odometry.kernel.gyro.reversed to true"));
}

TEST(WiringFaultText, AllDirectionsReversed_NamesTheMount) {
  WiringFaults faults;
  faults.are_swapped = faults.left_is_reversed = faults.right_is_reversed = true;
  EXPECT_THAT(described(faults), HasSubstr("lidar.mount.theta"));
  faults.are_swapped = false;
  EXPECT_THAT(described(faults), HasSubstr("both wheels count backward"));
  EXPECT_THAT(described(faults), Not(HasSubstr("mount")));
}

TEST(WiringFaultText, GyroInDegrees_IsNamed) {
  WiringFaults faults;
  faults.gyro_factor = 58.4;
  EXPECT_THAT(described(faults), HasSubstr("degrees a second"));
  faults.gyro_factor = 3;
  EXPECT_THAT(described(faults), Not(HasSubstr("degrees")));
}

}  // namespace
}  // namespace cornerd::tool
