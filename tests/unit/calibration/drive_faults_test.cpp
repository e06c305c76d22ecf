// SPDX-License-Identifier: MIT
#include "calibration/drive_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
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

TEST(DriveFaults, LidarTurnedBy180AndWrongCounts_IsEitherToo) {
  EXPECT_THAT(names(Robot{.change =
                              [](OdometryIncrement& step) {
                                step.left_m *= 2;
                                step.right_m *= 2;
                              },
                          .true_mount = {0, 0, core::kPi}}),
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

TEST(DriveFaults, MountInAnotherUnit_IsNamedWithItsPlace) {
  for (const auto& [x_m, y_m] : {std::pair(1.0, 0.0), {-4.0, 0.0}, {0.0, 10.0}, {-0.5, 2.0}}) {
    const DriveFaults faults =
        faults_of(Robot{.configured = {x_m, y_m, 0.4}, .true_mount = {0.01, -0.02, 0.4}});
    ASSERT_THAT(names_of(faults), ElementsAre("mount-position")) << x_m << ' ' << y_m;
    EXPECT_NEAR(faults.drive.front().T_base_lidar.x_m, 0.01, 0.005);
    EXPECT_NEAR(faults.drive.front().T_base_lidar.y_m, -0.02, 0.01);
  }
}

TEST(DriveFaults, MountThatDoesNotAccountForTheMotion_IsNotProposed) {
  // A robot on mecanum wheels that drives sideways now and then.
  Pose2 slip;
  KnownDrive known = known_drive({}, 1);
  for (std::size_t i = 0; i < known.places.size(); ++i) {
    slip.y_m += i / 20 % 2 == 0 ? 0.03 : -0.02 * (i % 3);
    known.places[i].T_map_base = known.places[i].T_map_base * slip;
  }
  const Pose2 configured{0.3, 0.2, 0};
  const DriveFaults faults =
      find_drive_faults(motion_windows(known.steps, known.places, configured), configured, {});
  EXPECT_THAT(names_of(faults), ElementsAre("encoders"));
}

TEST(DriveFaults, LateOrEarlyReadings_AreNamed) {
  for (const double delay_s : {-0.4, -0.3, 0.3, 0.4}) {
    const DriveFaults faults = faults_of(Robot{.change = [&](OdometryIncrement& step) {
      step.from_ns += core::from_seconds(delay_s);
      step.to_ns += core::from_seconds(delay_s);
    }});
    ASSERT_THAT(names_of(faults), ElementsAre("odometry-delay")) << delay_s;
    EXPECT_NEAR(faults.drive.front().delay_s, delay_s, 0.1);
    EXPECT_THAT(describe(faults, {}), testing::Not(testing::HasSubstr(";")));
  }
}

TEST(DriveFaults, DelayThatTheFilterEstimates_IsNone) {
  for (const double delay_s : {-0.15, 0.15}) {
    EXPECT_THAT(names([&](OdometryIncrement& step) {
                  step.from_ns += core::from_seconds(delay_s);
                  step.to_ns += core::from_seconds(delay_s);
                }),
                IsEmpty());
  }
}

TEST(DriveFaults, OneEncoderOnBothInputs_IsNamed) {
  const DriveFaults faults =
      faults_of(Robot{.change = [](OdometryIncrement& step) { step.right_m = step.left_m; }});
  ASSERT_THAT(names_of(faults), ElementsAre("right-encoder"));
  EXPECT_THAT(describe(faults, {}), testing::HasSubstr("are those of the left wheel"));
  EXPECT_THAT(names([](OdometryIncrement& step) { step.left_m = step.right_m; }),
              ElementsAre("left-encoder"));
}

TEST(DriveFaults, MountWithinATapesError_IsNone) {
  EXPECT_THAT(names(Robot{.true_mount = {0.008, -0.008, core::radians(0.4)}}), IsEmpty());
}

TEST(DriveFaults, WrongCounts_GiveFactor) {
  for (const double factor : {0.25, 0.5, 2.0, 4.0, 30.0}) {
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
  for (const double factor : {2.5, 62.5}) {
    core::DriveGeometry wide;
    wide.track_m *= factor;
    const DriveFaults faults = faults_of(Robot{.geometry = wide});
    ASSERT_THAT(names_of(faults), ElementsAre("track")) << factor;
    EXPECT_NEAR(faults.drive.front().track_m, 0.16, 0.01);
  }
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
  // The last two: raw counts of a chip, and millidegrees.
  for (const double factor : {3.0, 7506.0, 57296.0}) {
    EXPECT_THAT(names([=](OdometryIncrement& step) { step.gyro_rad *= factor; }),
                ElementsAre("gyro-scale"))
        << factor;
  }
  const DriveFaults biased = faults_of(
      Robot{.change = [](OdometryIncrement& step) { step.gyro_rad += 0.6 * step.duration_s(); }});
  ASSERT_THAT(names_of(biased), ElementsAre("gyro-bias"));
  EXPECT_NEAR(biased.gyro.front().bias_rad_s, 0.61, 0.01);
  int i = 0;
  EXPECT_THAT(names([&](OdometryIncrement& step) { step.gyro_rad = 0.02 * std::sin(++i * 7.0); }),
              ElementsAre("gyro-axis"));
}

TEST(DriveFaults, StuckGyro_IsNamed) {
  EXPECT_THAT(names([](OdometryIncrement& step) {
                step.has_gyro = step.from_ns < 50 * core::kNsPerSecond;
                step.gyro_may_be_stuck = !step.has_gyro;
              }),
              ElementsAre("gyro-stuck"));
}

}  // namespace
}  // namespace cornerd::calibration
