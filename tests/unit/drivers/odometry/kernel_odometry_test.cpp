// SPDX-License-Identifier: MIT
#include "drivers/odometry/kernel_odometry.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "sysfs_tree.hpp"

namespace cornerd::drivers {
namespace {

constexpr core::TimeNs kMs = 1'000'000;

/// Advances on wait(), then calls on_wait.
class TestClock : public Clock {
 public:
  core::TimeNs monotonic_ns() override { return now_ns += read_takes_ns; }
  core::TimeNs unix_offset_ns() override { return core::kNsPerSecond; }
  void wait(std::chrono::milliseconds duration, const std::stop_token&) override {
    now_ns += std::chrono::nanoseconds(duration).count();
    if (on_wait) on_wait();
  }
  core::TimeNs now_ns = 0;
  core::TimeNs read_takes_ns = 0;
  std::function<void()> on_wait;
};

class ReadingList : public OdometrySink {
 public:
  void on_reading(const core::OdometryReading& reading) override { all.push_back(reading); }
  std::vector<core::OdometryReading> all;
};

class KernelOdometryTest : public ::testing::Test {
 protected:
  KernelOdometryTest() {
    config_.sysfs = tree_.root();
    config_.left.counter = "48300180.counter";
    config_.right.counter = "48304180.counter";
    config_.gyro.device = "mpu6050";
  }
  void add_all() {
    tree_.add_counter(0, config_.left.counter);
    tree_.add_counter(1, config_.right.counter);
    tree_.add_gyro(0, config_.gyro.device);
  }
  /// Runs for `waits` waits; `at_wait` is called with each one's number, from 1.
  void run(
      int waits, const std::function<void(int)>& at_wait = [](int) {}) {
    std::stop_source stop;
    int count = 0;
    clock_.on_wait = [&] {
      at_wait(++count);
      if (count == waits) stop.request_stop();
    };
    driver_.emplace(config_, clock_);
    driver_->run(stop.get_token(), readings_);
  }
  SensorState left() { return driver_->status().left.state; }

  test::SysfsTree tree_;
  KernelOdometryConfig config_;
  TestClock clock_;
  ReadingList readings_;
  std::optional<KernelOdometry> driver_;
};

TEST_F(KernelOdometryTest, AllSensors_GiveReadingsAtTheRate) {
  add_all();
  tree_.set_count(0, "10");
  tree_.set_count(1, "20");
  tree_.set_rate(0, "30");
  run(50);
  ASSERT_EQ(readings_.all.size(), 50u);
  EXPECT_EQ(readings_.all.front().left, 10);
  EXPECT_EQ(readings_.all.front().right, 20);
  EXPECT_DOUBLE_EQ(readings_.all.front().gyro_rad_s.value(), 30 * 0.001064724);
  EXPECT_EQ(readings_.all.front().t_ns, 0);
  EXPECT_EQ(readings_.all.back().t_ns, 49 * 20 * kMs);
  EXPECT_EQ(driver_->status().counters.readings, 50u);
}

TEST_F(KernelOdometryTest, PeriodOfFractionalMilliseconds_IsKeptOnAverage) {
  add_all();
  config_.rate_hz = 60;
  run(121);
  EXPECT_NEAR(core::to_seconds(readings_.all.back().t_ns - readings_.all.front().t_ns), 2, 0.002);
}

TEST_F(KernelOdometryTest, NoSensors_GiveNoReadingsAndStateAbsent) {
  run(10);
  EXPECT_TRUE(readings_.all.empty());
  EXPECT_EQ(left(), SensorState::kAbsent);
  EXPECT_EQ(driver_->status().gyro.state, SensorState::kAbsent);
}

TEST_F(KernelOdometryTest, SensorsAddedLater_AreFoundWithinASecond) {
  run(60, [&](int count) {
    if (count == 5) add_all();
  });
  EXPECT_FALSE(readings_.all.empty());
  EXPECT_EQ(left(), SensorState::kRunning);
}

TEST_F(KernelOdometryTest, OneSensorMissing_LeavesTheOthers) {
  add_all();
  tree_.remove(test::SysfsTree::counter(0));
  run(3);
  ASSERT_EQ(readings_.all.size(), 3u);
  EXPECT_FALSE(readings_.all[0].left);
  EXPECT_TRUE(readings_.all[0].right);
  EXPECT_TRUE(readings_.all[0].gyro_rad_s);
}

TEST_F(KernelOdometryTest, InvalidValue_IsLeftOutOfTheReading) {
  add_all();
  run(3, [&](int count) { tree_.set_rate(0, count == 1 ? "garbage" : "1"); });
  ASSERT_EQ(readings_.all.size(), 3u);
  EXPECT_FALSE(readings_.all[1].gyro_rad_s);
  EXPECT_TRUE(readings_.all[1].left);
  EXPECT_TRUE(readings_.all[2].gyro_rad_s);
  EXPECT_EQ(driver_->status().counters.invalid_values, 1u);
}

TEST_F(KernelOdometryTest, ConstantEncoder_IsStuck) {
  add_all();
  run(50, [&](int count) { tree_.set_count(1, std::to_string(1000 * count)); });
  EXPECT_EQ(left(), SensorState::kStuck);
  EXPECT_EQ(driver_->status().right.state, SensorState::kRunning);
  EXPECT_EQ(driver_->status().gyro.state, SensorState::kStuck);
}

TEST_F(KernelOdometryTest, CountsReadFarApart_AreLeftOut) {
  add_all();
  config_.rate_hz = 10;
  clock_.read_takes_ns = 6 * kMs;
  run(2);
  ASSERT_FALSE(readings_.all.empty());
  EXPECT_FALSE(readings_.all[0].left);
  EXPECT_TRUE(readings_.all[0].gyro_rad_s);
  EXPECT_GT(driver_->status().counters.late, 0u);
}

}  // namespace
}  // namespace cornerd::drivers
