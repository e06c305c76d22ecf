// SPDX-License-Identifier: MIT
#include "calibration/drive_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "calibration/drive_fault_text.hpp"
#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

using core::OdometryIncrement;
using core::Pose2;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

using Change = std::function<void(OdometryIncrement&)>;

/// `true_mount`: where the lidar is, while the config says `configured`.
struct Robot {
  Change change = [](OdometryIncrement&) {};
  double rotations = 1;
  core::DriveGeometry geometry{};
  Pose2 configured{};
  Pose2 true_mount{};
};

DriveFaults faults_of(const Robot& setup) {
  KnownDrive known = known_drive({}, setup.rotations);
  for (OdometryIncrement& step : known.steps) setup.change(step);
  // The localizer finds the lidar, and takes the base from the config.
  for (KnownPose& place : known.places) {
    place.T_map_base = place.T_map_base * setup.true_mount * setup.configured.inverse();
  }
  const auto windows = motion_windows(known.steps, known.places, setup.configured);
  return find_drive_faults(windows, setup.configured, setup.geometry);
}

std::vector<std::string_view> names(const Robot& setup) { return names_of(faults_of(setup)); }
std::vector<std::string_view> names(const Change& change) { return names(Robot{change}); }

TEST(DriveFaults, ScaleErrorsOfMeasuredRobots_AreNone) {
  EXPECT_THAT(names(Robot{}), IsEmpty());
  EXPECT_THAT(names([](OdometryIncrement& step) { step.has_gyro = false; }), IsEmpty());
  EXPECT_THAT(names([](OdometryIncrement& step) { step.left_m *= 1.1; }), IsEmpty());
  EXPECT_THAT(names([](OdometryIncrement& step) { step.gyro_rad *= 0.85; }), IsEmpty());
}

TEST(DriveFaults, SlipsAndJitter_AreNone) {
  int i = 0;
  EXPECT_THAT(names([&](OdometryIncrement& step) {
                if (++i % 200 == 0) step.left_m += 0.1;
                step.right_m += 0.002 * std::sin(i * 7.0);
                step.gyro_rad += 0.01 * std::cos(i * 11.0);
              }),
              IsEmpty());
}

TEST(DriveFaults, StraightOn_SwappedWheelsDoNotShow) {
  const Change swap = [](OdometryIncrement& step) { std::swap(step.left_m, step.right_m); };
  EXPECT_THAT(names(Robot{.change = swap, .rotations = 0}), IsEmpty());
}

TEST(DriveFaults, WiringOfWheels_IsNamed) {
  EXPECT_THAT(names([](OdometryIncrement& step) { std::swap(step.left_m, step.right_m); }),
              ElementsAre("wheels-swapped"));
  EXPECT_THAT(names([](OdometryIncrement& step) { step.left_m *= -1; }),
              ElementsAre("left-wheel-reversed"));
  EXPECT_THAT(names([](OdometryIncrement& step) { step.right_m *= -1; }),
              ElementsAre("right-wheel-reversed"));
  EXPECT_THAT(names([](OdometryIncrement& step) {
                step.left_m *= -1;
                step.right_m *= -1;
              }),
              ElementsAre("wheels-reversed"));
  EXPECT_THAT(names([](OdometryIncrement& step) {
                std::swap(step.left_m, step.right_m);
                step.left_m *= -1;
              }),
              ElementsAre("wheels-swapped-left-reversed"));
}

TEST(DriveFaults, LidarTurnedBy180_OrWheelsSwappedAndReversed_BothNamed) {
  EXPECT_THAT(names(Robot{.true_mount = {0, 0, core::kPi}}),
              UnorderedElementsAre("mount-theta", "wheels-swapped-and-reversed"));
  EXPECT_THAT(names([](OdometryIncrement& step) {
                std::swap(step.left_m, step.right_m);
                step.left_m *= -1;
                step.right_m *= -1;
              }),
              UnorderedElementsAre("mount-theta", "wheels-swapped-and-reversed"));
}

TEST(DriveFaults, TurnedMount_IsNamedWithItsAngle) {
  for (const double degrees : {90.0, -90.0, 10.0, 2.0, -45.0}) {
    const Pose2 configured{0.05, -0.02, 0.3};
    const DriveFaults faults = faults_of(
        Robot{.configured = configured, .true_mount = {0.05, -0.02, 0.3 + core::radians(degrees)}});
    ASSERT_THAT(names_of(faults), ElementsAre("mount-theta")) << degrees;
    EXPECT_NEAR(faults.drive.front().T_base_lidar.theta_rad, 0.3 + core::radians(degrees), 0.006);
    EXPECT_NEAR(faults.mount.T_base_lidar.x_m, 0.05, 0.005) << degrees;
    EXPECT_NEAR(faults.mount.T_base_lidar.y_m, -0.02, 0.01) << degrees;
  }
}

TEST(DriveFaults, DisplacedMount_IsNamedWithItsPlace) {
  for (const auto& [x_m, y_m] : {std::pair(0.05, 0.0), {0.0, 0.05}, {-0.05, 0.0}, {0.1, -0.1}}) {
    const DriveFaults faults = faults_of(Robot{.true_mount = {x_m, y_m, 0}});
    ASSERT_THAT(names_of(faults), ElementsAre("mount-position")) << x_m << ' ' << y_m;
    EXPECT_NEAR(faults.drive.front().T_base_lidar.x_m, x_m, 0.005);
    EXPECT_NEAR(faults.drive.front().T_base_lidar.y_m, y_m, 0.01);
  }
}

TEST(DriveFaults, MountWithinATapesError_IsNone) {
  EXPECT_THAT(names(Robot{.true_mount = {0.008, -0.008, core::radians(0.4)}}), IsEmpty());
}

TEST(DriveFaults, WrongCounts_GiveFactor) {
  for (const double factor : {0.25, 0.5, 2.0, 4.0}) {
    const DriveFaults faults = faults_of(Robot{.change = [&](OdometryIncrement& step) {
      step.left_m /= factor;
      step.right_m /= factor;
    }});
    ASSERT_THAT(names_of(faults), ElementsAre("counts-per-turn")) << factor;
    EXPECT_NEAR(faults.drive.front().factor / factor, 1.02, 0.02);
  }
  const DriveFaults one =
      faults_of(Robot{.change = [](OdometryIncrement& step) { step.right_m *= 4; }});
  ASSERT_THAT(names_of(one), ElementsAre("right-counts"));
  EXPECT_NEAR(one.drive.front().factor, 0.25, 0.02);
}

TEST(DriveFaults, WrongTrack_GivesTrueTrack) {
  core::DriveGeometry wide;
  wide.track_m *= 2.5;
  const DriveFaults faults = faults_of(Robot{.geometry = wide});
  ASSERT_THAT(names_of(faults), ElementsAre("track"));
  EXPECT_NEAR(faults.drive.front().track_m, 0.16, 0.01);
}

TEST(DriveFaults, DeadEncoder_IsNamed) {
  const DriveFaults left =
      faults_of(Robot{.change = [](OdometryIncrement& step) { step.left_m = 0; }});
  ASSERT_THAT(names_of(left), ElementsAre("left-encoder"));
  EXPECT_TRUE(left.drive.front().is_silent);
  EXPECT_THAT(names([](OdometryIncrement& step) { step.right_m = 0; }),
              ElementsAre("right-encoder"));
  EXPECT_THAT(names([](OdometryIncrement& step) { step.left_m = step.right_m = 0; }),
              ElementsAre("encoders"));
}

TEST(DriveFaults, TwoFaults_AreNamedTogether) {
  EXPECT_THAT(names([](OdometryIncrement& step) {
                std::swap(step.left_m, step.right_m);
                step.gyro_rad *= -1;
              }),
              ElementsAre("wheels-swapped", "gyro-reversed"));
  const DriveFaults both = faults_of(Robot{.change = [](OdometryIncrement& step) {
    std::swap(step.left_m, step.right_m);
    step.left_m *= 4;
    step.right_m *= 4;
  }});
  ASSERT_THAT(names_of(both), ElementsAre("wheels-swapped"));
  EXPECT_NEAR(both.drive.front().factor, 0.255, 0.01);
}

TEST(DriveFaults, WrongGyro_IsNamed) {
  EXPECT_THAT(names([](OdometryIncrement& step) { step.gyro_rad *= -1; }),
              ElementsAre("gyro-reversed"));
  EXPECT_THAT(names([](OdometryIncrement& step) { step.gyro_rad = core::degrees(step.gyro_rad); }),
              ElementsAre("gyro-degrees"));
  EXPECT_THAT(names([](OdometryIncrement& step) { step.gyro_rad = -core::degrees(step.gyro_rad); }),
              ElementsAre("gyro-degrees-reversed"));
  EXPECT_THAT(names([](OdometryIncrement& step) { step.gyro_rad *= 3; }),
              ElementsAre("gyro-scale"));
  const DriveFaults biased = faults_of(
      Robot{.change = [](OdometryIncrement& step) { step.gyro_rad += 0.6 * step.duration_s(); }});
  ASSERT_THAT(names_of(biased), ElementsAre("gyro-bias"));
  EXPECT_NEAR(biased.gyro.front().bias_rad_s, 0.61, 0.01);
  int i = 0;
  EXPECT_THAT(names([&](OdometryIncrement& step) { step.gyro_rad = 0.02 * std::sin(++i * 7.0); }),
              ElementsAre("gyro-axis"));
}

/// Drives whose parameters did not tune the model.
class RandomDrive {
 public:
  explicit RandomDrive(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double normal(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

  /// The faults after a drive of a robot with a right set-up, `change`d.
  DriveFaults faults(const Change& change = {}) {
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

TEST(DriveFaults, RandomRightSetups_AreNone) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    EXPECT_THAT(names_of(RandomDrive(seed).faults()), IsEmpty()) << seed;
  }
}

TEST(DriveFaults, RandomSetupsWithAFault_AreNamed) {
  const std::pair<std::string_view, Change> cases[] = {
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
