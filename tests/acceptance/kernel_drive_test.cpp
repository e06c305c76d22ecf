// SPDX-License-Identifier: MIT
// A drive with the kernel's counter and IIO drivers as files, from their texts to the pose:
// wrapping, jumping, stuck, absent and invalid values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bench/simulated_drive.hpp"
#include "core/pipeline.hpp"
#include "drivers/odometry/kernel_odometry.hpp"
#include "replay/pose_error.hpp"
#include "replay/simulator/motion.hpp"
#include "replay/simulator/scene.hpp"
#include "replay/simulator/simulated_odometry.hpp"
#include "replay/simulator/simulator.hpp"
#include "settings/map_file.hpp"
#include "tests/unit/drivers/odometry/sysfs_tree.hpp"

namespace cornerd {
namespace {

constexpr core::TimeNs kPeriod_ns = core::kNsPerSecond / 50;
constexpr double kGyroScale_rad_s = 0.001064724;
constexpr double kDrive_s = 20;
/// Start of the time without the lidar.
constexpr double kCovered_s = 15;
constexpr double kSeesAgain_s = 17;

/// The next texts of the files; a test may change them, or the tree.
struct Texts {
  std::string left;
  std::string right;
  std::string rate;
};
using Fault = std::function<void(Texts&, test::SysfsTree&, double t_s)>;

struct Driven {
  std::size_t fixes = 0;
  std::size_t predicted = 0;
  std::size_t wrong = 0;
  double worst_m = 0;
  core::OdometrySummary odometry;
  drivers::OdometryStatus sensors;
};

/// Simulated time: waiting advances the robot, its files and its lidar.
class KernelDrive : public drivers::Clock, public drivers::OdometrySink {
 public:
  KernelDrive(Fault fault, std::int64_t counter_max, std::int64_t first_count)
      : map_(settings::load_map(CORNERD_SOURCE_DIR "/config/maps/flat-7.json")),
        motion_(
            replay::drive_path(replay::find_scenario("circuit-1")->path, bench::gentle_drive())),
        fault_(std::move(fault)),
        counter_max_(counter_max),
        first_count_(first_count) {
    robot_.geometry.counter_max = 0;
    config_.odometry.enabled = true;
    config_.odometry.geometry.counter_max = counter_max;
  }

  Driven drive() {
    tree_.add_counter(0, kLeft);
    tree_.add_counter(1, kRight);
    tree_.add_gyro(0, kGyro);
    for (int i = 0; i < 2; ++i) {
      tree_.set_of_count(i, "ceiling", std::to_string(counter_max_));
    }
    auto scene =
        std::make_unique<replay::CoverableScene>(std::make_unique<replay::MapScene>(map_, motion_));
    scene_ = scene.get();
    simulator_.emplace(std::move(scene), replay::SimulatorConfig{});
    odometry_.emplace(motion_, robot_, 7);
    pipeline_.emplace(map_, config_);
    write_texts();

    drivers::KernelOdometryConfig kernel;
    kernel.sysfs = tree_.root();
    kernel.left.counter = kLeft;
    kernel.right.counter = kRight;
    kernel.gyro.device = kGyro;
    kernel.geometry = config_.odometry.geometry;
    drivers::KernelOdometry driver(kernel, *this);
    driver.run(stop_.get_token(), *this);
    driven_.sensors = driver.status();
    return driven_;
  }

  core::TimeNs monotonic_ns() override { return now_ns_; }
  core::TimeNs unix_offset_ns() override { return 0; }
  void wait(std::chrono::milliseconds duration, const std::stop_token&) override {
    now_ns_ += std::chrono::nanoseconds(duration).count();
    look_around();
    write_texts();
    if (core::to_seconds(now_ns_) > kDrive_s) stop_.request_stop();
  }
  void on_reading(const core::OdometryReading& reading) override {
    pipeline_->add(reading.arrived(now_ns_));
  }

 private:
  static constexpr const char* kLeft = "48300180.counter";
  static constexpr const char* kRight = "48304180.counter";
  static constexpr const char* kGyro = "mpu6050";

  void write_texts() {
    while (odometry_->next_ns() <= now_ns_) reading_ = odometry_->next();
    const auto count = [&](std::int64_t counted) {
      const std::int64_t counts = counter_max_ + 1;
      return std::to_string(((counted + first_count_) % counts + counts) % counts);
    };
    Texts texts{count(*reading_.left), count(*reading_.right),
                std::to_string(std::lround(*reading_.gyro_rad_s / kGyroScale_rad_s))};
    fault_(texts, tree_, core::to_seconds(now_ns_));
    if (texts.left != texts_.left) tree_.set_count(0, texts.left);
    if (texts.right != texts_.right) tree_.set_count(1, texts.right);
    if (texts.rate != texts_.rate) tree_.set_rate(0, texts.rate);
    texts_ = texts;
  }

  /// Adds the lidar's samples up to now.
  void look_around() {
    const double now_s = core::to_seconds(now_ns_);
    scene_->cover(now_s >= kCovered_s && now_s < kSeesAgain_s);
    while (sampled_ns_ < now_ns_) {
      for (const replay::SimulatedSample& sample : simulator_->next().samples) {
        sampled_ns_ = sample.t_ns;
        if (const auto* result = pipeline_->add(replay::to_sample(sample))) judge(*result);
      }
    }
  }

  void judge(const core::ScanResult& result) {
    driven_.odometry = result.odometry;
    const bool is_fix = result.pose.state == core::PoseState::kFix;
    const bool is_predicted = result.pose.state == core::PoseState::kPredicted;
    if (!is_fix && !is_predicted) return;
    ++(is_fix ? driven_.fixes : driven_.predicted);
    const core::Pose2 truth = motion_(result.pose.t_ns, 0);
    if (!replay::is_right(result.pose.T_map_base, truth)) ++driven_.wrong;
    driven_.worst_m =
        std::max(driven_.worst_m, replay::error_of(result.pose.T_map_base, truth).position_m);
  }

  std::shared_ptr<const core::WallMap> map_;
  replay::Motion motion_;
  Fault fault_;
  std::int64_t counter_max_;
  std::int64_t first_count_;
  replay::RobotModel robot_;
  core::LocalizerConfig config_;
  test::SysfsTree tree_;
  replay::CoverableScene* scene_ = nullptr;
  std::optional<replay::Simulator> simulator_;
  std::optional<replay::SimulatedOdometry> odometry_;
  std::optional<core::Pipeline> pipeline_;
  core::OdometryReading reading_;
  Texts texts_;
  core::TimeNs now_ns_ = 0;
  core::TimeNs sampled_ns_ = 0;
  std::stop_source stop_;
  Driven driven_;
};

Driven drive(Fault fault, std::int64_t counter_max = 0xFFFFFFFF, std::int64_t first_count = 0) {
  return KernelDrive(std::move(fault), counter_max, first_count).drive();
}

bool is_between(double t_s, double from_s, double to_s) { return t_s >= from_s && t_s < to_s; }

void expect_unharmed(const Driven& driven) {
  EXPECT_EQ(driven.wrong, 0U);
  EXPECT_GE(driven.fixes, 125U);
  EXPECT_GE(driven.predicted, 12U);
  EXPECT_LT(driven.worst_m, 0.03);
  EXPECT_TRUE(driven.odometry.healthy);
}

TEST(DriveByKernelSensors, CoveredLidar_PosesArePredicted) {
  const Driven driven = drive([](Texts&, test::SysfsTree&, double) {});
  expect_unharmed(driven);
  EXPECT_EQ(driven.odometry.counters.jumps, 0U);
}

TEST(DriveByKernelSensors, CountsWrap_DriveContinues) {
  for (const auto& [counter_max, first] :
       {std::pair<std::int64_t, std::int64_t>{0xFFFFFFFF, 0xFFFFFF00}, {0xFFFF, 65000}, {999, 0}}) {
    const Driven driven = drive([](Texts&, test::SysfsTree&, double) {}, counter_max, first);
    expect_unharmed(driven);
    EXPECT_EQ(driven.odometry.counters.jumps, 0U) << counter_max;
    EXPECT_GT(driven.sensors.counters.wraps, 0U) << counter_max;
  }
}

TEST(DriveByKernelSensors, InvalidAndJumpingValues_OnlyTheyAreRejected) {
  int step = 0;
  const Driven driven = drive([&](Texts& texts, test::SysfsTree&, double) {
    ++step;
    if (step % 50 == 10) texts.left = std::to_string(std::stoll(texts.left) + 30464);
    if (step % 50 == 20) texts.right = "5198147";
    if (step % 50 == 30) texts.left = "garbage";
    if (step % 50 == 40) texts.rate = "5198147";
    if (step % 50 == 45) texts.rate = "";
  });
  expect_unharmed(driven);
  EXPECT_GE(driven.odometry.counters.jumps, 30U);
  EXPECT_GE(driven.sensors.counters.invalid_values, 30U);
}

TEST(DriveByKernelSensors, SensorReturnsUnderOtherNumber_IsFound) {
  bool is_gone = false;
  bool is_back = false;
  const Driven driven = drive([&](Texts&, test::SysfsTree& tree, double t_s) {
    if (t_s > 5 && !is_gone) {
      tree.remove(test::SysfsTree::gyro(0));
      is_gone = true;
    }
    if (t_s > 8 && !is_back) {
      tree.add_gyro(0, "mpu6050");
      is_back = true;
    }
  });
  EXPECT_EQ(driven.wrong, 0U);
  EXPECT_GE(driven.predicted, 12U);
  EXPECT_EQ(driven.sensors.gyro.state, drivers::SensorState::kRunning);
}

TEST(DriveByKernelSensors, GyroStuck_IsRejected) {
  std::string held;
  const Driven driven = drive([&](Texts& texts, test::SysfsTree&, double t_s) {
    if (t_s < 8) held = texts.rate;
    texts.rate = held;
  });
  expect_unharmed(driven);
  EXPECT_GT(driven.odometry.counters.stuck, 100U);
}

TEST(DriveByKernelSensors, EncoderStuck_IsReportedUnhealthy) {
  std::string held;
  const Driven driven = drive([&](Texts& texts, test::SysfsTree&, double t_s) {
    if (t_s < 8) held = texts.left;
    texts.left = held;
  });
  EXPECT_EQ(driven.wrong, 0U);
  EXPECT_GE(driven.fixes, 120U);
  EXPECT_EQ(driven.sensors.left.state, drivers::SensorState::kStuck);
}

TEST(DriveByKernelSensors, EncodersAbsent_GapIsCounted) {
  for (const double until_s : {8.0, 18.0}) {
    const Driven driven = drive([&](Texts& texts, test::SysfsTree&, double t_s) {
      if (is_between(t_s, 5, until_s)) texts.left = texts.right = "";
    });
    EXPECT_EQ(driven.wrong, 0U) << until_s;
    EXPECT_GE(driven.fixes, 120U) << until_s;
    EXPECT_EQ(driven.predicted > 0, until_s < kCovered_s) << until_s;
  }
}

}  // namespace
}  // namespace cornerd
