// SPDX-License-Identifier: MIT
#include "drivers/odometry/kernel_sensors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sysfs_tree.hpp"

namespace cornerd::drivers {
namespace {

using ::testing::HasSubstr;

constexpr const char* kName = "48304180.counter";

class EncoderTest : public ::testing::Test {
 protected:
  std::optional<std::int64_t> read_count(const std::string& text) {
    tree_.set_count(0, text);
    return encoder_.read();
  }
  std::string detail() const { return std::string(encoder_.status().detail.view()); }

  test::SysfsTree tree_;
  Encoder encoder_{tree_.root(), {.counter = kName}};
};

TEST_F(EncoderTest, SeveralCounters_FindsTheOneOfItsName) {
  tree_.add_counter(0, "48300180.counter");
  tree_.add_counter(1, kName);
  tree_.set_count(0, "1");
  tree_.set_count(1, "42");
  encoder_.refresh();
  EXPECT_EQ(encoder_.read(), 42);
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

TEST_F(EncoderTest, NoCounterOfThatName_IsAbsentAndListsOthers) {
  encoder_.refresh();
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  tree_.add_counter(0, "48302180.counter");
  encoder_.refresh();
  EXPECT_EQ(encoder_.read(), std::nullopt);
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  EXPECT_THAT(detail(), HasSubstr("48302180.counter"));
}

TEST_F(EncoderTest, TwoCountersOfOneName_IsAbsent) {
  tree_.add_counter(0, kName);
  tree_.add_counter(1, kName);
  encoder_.refresh();
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  EXPECT_THAT(detail(), HasSubstr("several"));
}

TEST_F(EncoderTest, CounterNotSetUp_IsDisabledUntilItIs) {
  tree_.add_counter(0, kName);
  for (const auto& [attribute, text, right] :
       {std::array{"enable", "0", "1"}, std::array{"function", "increase", "quadrature x4"},
        std::array{"ceiling", "0", "4294967295"}}) {
    tree_.set_of_count(0, attribute, text);
    encoder_.refresh();
    EXPECT_EQ(encoder_.status().state, SensorState::kDisabled) << attribute;
    EXPECT_THAT(detail(), HasSubstr(attribute));
    EXPECT_EQ(encoder_.read(), std::nullopt) << attribute;
    tree_.set_of_count(0, attribute, right);
    encoder_.refresh();
    EXPECT_TRUE(encoder_.read()) << attribute;
  }
}

TEST_F(EncoderTest, CountBeyondCeiling_IsUnwrapped) {
  tree_.add_counter(0, kName);
  encoder_.refresh();
  EXPECT_EQ(read_count("4294967290"), 4294967290);
  EXPECT_EQ(read_count("4"), 4294967300);
  EXPECT_EQ(read_count("4294967295"), 4294967295);
  EXPECT_EQ(encoder_.wraps(), 2u);
}

TEST_F(EncoderTest, CeilingOf999_IsUnwrapped) {
  tree_.add_counter(0, kName);
  tree_.set_of_count(0, "ceiling", "999");
  encoder_.refresh();
  EXPECT_EQ(read_count("990"), 990);
  EXPECT_EQ(read_count("5"), 1005);
}

TEST_F(EncoderTest, NoCeiling_DoesNotUnwrap) {
  tree_.add_counter(0, kName);
  tree_.remove(test::SysfsTree::counter(0) + "/count0/ceiling");
  encoder_.refresh();
  EXPECT_EQ(read_count("4294967295"), 4294967295);
  EXPECT_EQ(read_count("-5"), -5);
  EXPECT_EQ(encoder_.wraps(), 0u);
}

TEST_F(EncoderTest, Reversed_CountsBackwards) {
  tree_.add_counter(0, kName);
  Encoder reversed(tree_.root(), {.counter = kName, .reversed = true});
  reversed.refresh();
  tree_.set_count(0, "4294967290");
  EXPECT_EQ(reversed.read(), -4294967290);
  tree_.set_count(0, "4");
  EXPECT_EQ(reversed.read(), -4294967300);
}

TEST_F(EncoderTest, InvalidValue_IsOmittedAndCounted) {
  tree_.add_counter(0, kName);
  encoder_.refresh();
  EXPECT_EQ(read_count("7"), 7);
  for (const char* text : {"", "x", "7.5", "99999999999999999999", "\x80\xff"}) {
    EXPECT_EQ(read_count(text), std::nullopt) << text;
    EXPECT_EQ(encoder_.status().state, SensorState::kInvalid);
  }
  EXPECT_EQ(encoder_.invalid_values(), 5u);
  EXPECT_EQ(read_count("9"), 9);
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

TEST_F(EncoderTest, ReadError_IsUnreadableUntilItEnds) {
  tree_.add_counter(0, kName);
  const std::string count = test::SysfsTree::counter(0) + "/count0/count";
  tree_.remove(count);
  std::filesystem::create_directory(tree_.root() / count);  // opens, but read() fails
  encoder_.refresh();
  EXPECT_EQ(encoder_.read(), std::nullopt);
  EXPECT_EQ(encoder_.status().state, SensorState::kUnreadable);
  EXPECT_EQ(encoder_.failed_reads(), 1u);
  std::filesystem::remove(tree_.root() / count);
  tree_.set_count(0, "3");
  encoder_.refresh();
  EXPECT_EQ(encoder_.read(), 3);
}

TEST_F(EncoderTest, CounterBackUnderAnotherNumber_IsFoundAgain) {
  tree_.add_counter(0, kName);
  encoder_.refresh();
  EXPECT_EQ(read_count("7"), 7);
  tree_.remove(test::SysfsTree::counter(0));
  encoder_.refresh();
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  EXPECT_EQ(encoder_.read(), std::nullopt);
  tree_.add_counter(3, kName);
  tree_.set_count(3, "1");
  encoder_.refresh();
  EXPECT_TRUE(encoder_.read());
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

TEST_F(EncoderTest, SetStuck_ChangesOnlyARunningSensor) {
  encoder_.set_stuck(true);
  EXPECT_EQ(encoder_.status().state, SensorState::kAbsent);
  tree_.add_counter(0, kName);
  encoder_.refresh();
  encoder_.set_stuck(true);
  EXPECT_EQ(encoder_.status().state, SensorState::kStuck);
  EXPECT_EQ(encoder_.read(), 0);
  EXPECT_EQ(encoder_.status().state, SensorState::kStuck);
  encoder_.set_stuck(false);
  EXPECT_EQ(encoder_.status().state, SensorState::kRunning);
}

}  // namespace

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
  gyro_.refresh();
  EXPECT_DOUBLE_EQ(gyro_.read().value(), -128 * 0.001064724);
  EXPECT_EQ(gyro_.status().state, SensorState::kRunning);
}

TEST_F(GyroTest, ScaleAndOffsetOfTheAxis_TakePrecedence) {
  tree_.add_gyro(0, "mpu6050");
  tree_.write(file("in_anglvel_z_scale"), "0.5");
  tree_.write(file("in_anglvel_z_offset"), "-100");
  tree_.set_rate(0, "104");
  gyro_.refresh();
  EXPECT_EQ(gyro_.read(), 2);
}

TEST_F(GyroTest, ChangedScale_IsReadAgain) {
  tree_.add_gyro(0, "mpu6050");
  tree_.set_rate(0, "10");
  gyro_.refresh();
  tree_.write(file("in_anglvel_scale"), "0.1");
  gyro_.refresh();
  EXPECT_EQ(gyro_.read(), 1);
}

TEST_F(GyroTest, AxisAndDirection_FollowTheConfig) {
  tree_.add_gyro(0, "mpu6050");
  tree_.write(file("in_anglvel_scale"), "0.5");
  tree_.write(file("in_anglvel_x_raw"), "4");
  Gyro reversed(tree_.root(), {.device = "mpu6050", .axis = 'x', .reversed = true});
  reversed.refresh();
  EXPECT_EQ(reversed.read(), -2);
}

TEST_F(GyroTest, TwoEqualChips_LabelSelectsOne) {
  tree_.add_gyro(0, "mpu6050");
  tree_.add_gyro(1, "mpu6050");
  tree_.write(test::SysfsTree::gyro(1) + "/label", "base-imu");
  tree_.set_rate(1, "5");
  gyro_.refresh();
  EXPECT_EQ(gyro_.status().state, SensorState::kAbsent);
  Gyro labelled(tree_.root(), {.device = "base-imu"});
  labelled.refresh();
  EXPECT_DOUBLE_EQ(labelled.read().value(), 5 * 0.001064724);
}

TEST_F(GyroTest, NoDeviceConfigured_HasStateNone) {
  Gyro none(tree_.root(), {});
  none.refresh();
  EXPECT_EQ(none.status().state, SensorState::kNone);
  EXPECT_EQ(none.read(), std::nullopt);
}

TEST_F(GyroTest, ChipWithoutScale_IsUnreadable) {
  tree_.add_gyro(0, "mpu6050");
  tree_.remove(file("in_anglvel_scale"));
  gyro_.refresh();
  EXPECT_EQ(gyro_.status().state, SensorState::kUnreadable);
  EXPECT_THAT(std::string(gyro_.status().detail.view()), HasSubstr("scale"));
}

TEST_F(GyroTest, InvalidScale_IsUnreadable) {
  tree_.add_gyro(0, "mpu6050");
  for (const char* text : {"nan", "0", "0.000000000", "1e400", ""}) {
    tree_.write(file("in_anglvel_scale"), text);
    gyro_.refresh();
    EXPECT_EQ(gyro_.read(), std::nullopt) << text;
    EXPECT_EQ(gyro_.status().state, SensorState::kUnreadable) << text;
  }
}

}  // namespace

}  // namespace cornerd::drivers
