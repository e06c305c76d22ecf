// SPDX-License-Identifier: MIT
#include "drivers/odometry/gyro.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sysfs_tree.hpp"

namespace cornerd::drivers {
namespace {

using ::testing::HasSubstr;

class GyroTest : public ::testing::Test {
 protected:
  static std::string file(const char* attribute) {
    return test::SysfsTree::gyro(0) + "/" + attribute;
  }

  test::SysfsTree tree_;
  Gyro gyro_{tree_.root(), {.device = "mpu6050"}};
};

TEST_F(GyroTest, Rate_IsRawTimesScale) {
  tree_.add_gyro(0, "mpu6050");
  tree_.set_rate(0, "-128");
  gyro_.look();
  EXPECT_DOUBLE_EQ(gyro_.read().value(), -128 * 0.001064724);
  EXPECT_EQ(gyro_.status().state, SensorState::kRunning);
}

TEST_F(GyroTest, ScaleAndOffsetOfTheAxis_GoBeforeThoseOfAll) {
  tree_.add_gyro(0, "mpu6050");
  tree_.write(file("in_anglvel_z_scale"), "0.5");
  tree_.write(file("in_anglvel_z_offset"), "-100");
  tree_.set_rate(0, "104");
  gyro_.look();
  EXPECT_EQ(gyro_.read(), 2);
}

TEST_F(GyroTest, RangeThatIsChanged_IsNoticed) {
  tree_.add_gyro(0, "mpu6050");
  tree_.set_rate(0, "10");
  gyro_.look();
  tree_.write(file("in_anglvel_scale"), "0.1");
  gyro_.look();
  EXPECT_EQ(gyro_.read(), 1);
}

TEST_F(GyroTest, AxisAndDirection_AreTheConfigs) {
  tree_.add_gyro(0, "mpu6050");
  tree_.write(file("in_anglvel_scale"), "0.5");
  tree_.write(file("in_anglvel_x_raw"), "4");
  Gyro reversed(tree_.root(), {.device = "mpu6050", .axis = 'x', .reversed = true});
  reversed.look();
  EXPECT_EQ(reversed.read(), -2);
}

TEST_F(GyroTest, Label_NamesOneOfTwoEqualChips) {
  tree_.add_gyro(0, "mpu6050");
  tree_.add_gyro(1, "mpu6050");
  tree_.write(test::SysfsTree::gyro(1) + "/label", "base-imu");
  tree_.set_rate(1, "5");
  gyro_.look();
  EXPECT_EQ(gyro_.status().state, SensorState::kAbsent);
  Gyro labelled(tree_.root(), {.device = "base-imu"});
  labelled.look();
  EXPECT_DOUBLE_EQ(labelled.read().value(), 5 * 0.001064724);
}

TEST_F(GyroTest, NoneConfigured_IsNoFault) {
  Gyro none(tree_.root(), {});
  none.look();
  EXPECT_EQ(none.status().state, SensorState::kNone);
  EXPECT_EQ(none.read(), std::nullopt);
}

TEST_F(GyroTest, ChipWithoutAGyro_IsUnreadable) {
  tree_.add_gyro(0, "mpu6050");
  tree_.remove(file("in_anglvel_scale"));
  gyro_.look();
  EXPECT_EQ(gyro_.status().state, SensorState::kUnreadable);
  EXPECT_THAT(std::string(gyro_.status().detail.view()), HasSubstr("scale"));
}

TEST_F(GyroTest, ScaleThatIsGarbage_IsNotReckonedWith) {
  tree_.add_gyro(0, "mpu6050");
  for (const char* text : {"nan", "0", "0.000000000", "1e400", ""}) {
    tree_.write(file("in_anglvel_scale"), text);
    gyro_.look();
    EXPECT_EQ(gyro_.read(), std::nullopt) << text;
    EXPECT_EQ(gyro_.status().state, SensorState::kUnreadable) << text;
  }
}

}  // namespace
}  // namespace cornerd::drivers
