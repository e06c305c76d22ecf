// SPDX-License-Identifier: MIT
#include "calibration/drive_bank.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <string_view>
#include <utility>
#include <vector>

#include "calibration/drive_fault_text.hpp"
#include "calibration/drive_faults.hpp"

namespace cornerd::calibration {
namespace {

using core::OdometryIncrement;
using core::Pose2;
using testing::Contains;
using testing::IsEmpty;

using DriveChange = std::function<void(OdometryIncrement&)>;

/// Drives whose parameters did not tune the model.
class RandomDrive {
 public:
  explicit RandomDrive(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double normal(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

  /// The faults after a drive of a robot with a right set-up, `change`d.
  DriveFaults faults(const DriveChange& change = {}) {
    core::DriveGeometry geometry;
    geometry.track_m = uniform(0.1, 0.6);
    const double speed_m_s = uniform(0.1, 1);
    const double rate_rad_s = uniform(0.3, 2);
    const double left = 1 + normal(0.03);
    const double right = 1 + normal(0.03);
    const double track_m = geometry.track_m * (1 + normal(0.04));
    const double gyro = 1 + normal(0.02);
    const double bias_rad_s = normal(0.02);
    const double slips = uniform(0, 0.03);
    const double fix_m = uniform(0.001, 0.006);
    const core::TimeNs late_ns = core::from_seconds(uniform(0, 0.08));
    const Pose2 mount{uniform(-0.2, 0.2), uniform(-0.2, 0.2), uniform(-3, 3)};
    const Pose2 configured{mount.x_m + normal(0.004), mount.y_m + normal(0.004),
                           mount.theta_rad + normal(core::radians(0.2))};
    std::vector<OdometryIncrement> steps;
    std::vector<KnownPose> places;
    Pose2 T_map_base;
    double speed = 0;
    double rate = 0;
    double wanted_rate = 0;
    double wanted_speed = speed_m_s;
    constexpr double kStep_s = 0.02;
    for (int i = 0; i < 3000; ++i) {
      const core::TimeNs now_ns = i * core::TimeNs{20'000'000};
      if (i % 75 == 0) {
        wanted_rate = uniform(0, 1) < 0.4 ? 0 : uniform(-rate_rad_s, rate_rad_s);
        wanted_speed = uniform(0, 1) < 0.15 ? 0 : speed_m_s;
      }
      speed += std::clamp(wanted_speed - speed, -kStep_s, kStep_s);
      rate += std::clamp(wanted_rate - rate, -3 * kStep_s, 3 * kStep_s);
      if (i % 8 == 0) {
        const Pose2 noise{normal(fix_m), normal(fix_m), normal(0.003)};
        places.push_back({now_ns, T_map_base * mount * noise * configured.inverse()});
      }
      const double rotation_rad = rate * kStep_s;
      T_map_base = T_map_base * core::arc(speed * kStep_s, rotation_rad);
      const double half_m = rotation_rad * track_m / 2;
      OdometryIncrement step;
      step.from_ns = now_ns + late_ns;
      step.to_ns = step.from_ns + 20'000'000;
      step.left_m = (speed * kStep_s - half_m) * left;
      step.right_m = (speed * kStep_s + half_m) * right;
      if (uniform(0, 1) < slips) step.left_m *= 3;
      step.gyro_rad = gyro * rotation_rad + (bias_rad_s + normal(0.02)) * kStep_s;
      step.has_gyro = true;
      if (change) change(step);
      steps.push_back(step);
    }
    return find_drive_faults(motion_windows(steps, places, configured), configured, geometry);
  }

 private:
  std::mt19937 random_;
};

TEST(DriveBank, RandomRightSetups_AreNone) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    EXPECT_THAT(names_of(RandomDrive(seed).faults()), IsEmpty()) << seed;
  }
}

TEST(DriveBank, RandomSetupsWithAFault_AreNamed) {
  const std::pair<std::string_view, DriveChange> cases[] = {
      {"wheels-swapped", [](OdometryIncrement& step) { std::swap(step.left_m, step.right_m); }},
      {"left-wheel-reversed", [](OdometryIncrement& step) { step.left_m *= -1; }},
      {"right-encoder", [](OdometryIncrement& step) { step.right_m = 0; }},
      {"counts-per-turn",
       [](OdometryIncrement& step) {
         step.left_m /= 4;
         step.right_m /= 4;
       }},
      {"gyro-reversed", [](OdometryIncrement& step) { step.gyro_rad *= -1; }},
      {"gyro-degrees", [](OdometryIncrement& step) { step.gyro_rad *= core::degrees(1); }}};
  for (const auto& [name, change] : cases) {
    for (unsigned seed = 1; seed <= 25; ++seed) {
      EXPECT_THAT(names_of(RandomDrive(seed).faults(change)), Contains(name)) << seed;
    }
  }
}

}  // namespace
}  // namespace cornerd::calibration
