// SPDX-License-Identifier: MIT
// What the odometer does with readings and fixes that contradict each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/odometry/odometer.hpp"
#include "driven_robot.hpp"
#include "odometer_drive.hpp"

namespace cornerd::core {
namespace {

using testing::kFixCovariance;
using testing::OdometerDrive;
using testing::switched_on;

TEST(Odometer, InconsistentWheels_AreRejected) {
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 50; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  // The robot is lifted: wheels move, the lidar's pose does not.
  const Pose2 hanging = ride.truth;
  for (int k = 0; k < 15; ++k) {
    ride.drive_scan();
    ride.odometer.correct(hanging, kFixCovariance);
  }
  EXPECT_FALSE(ride.odometer.prediction());
  EXPECT_FALSE(ride.odometer.summary().healthy);
  EXPECT_GT(ride.odometer.summary().rejected_fixes, 3U);
}

/// Largest error of an overconfident prediction in its own sigmas, in 5 s without fixes and with
/// corrupted readings; 0 without a prediction.
double worst_sigmas_while_blind(const std::function<void(int, OdometryReading&)>& spoil,
                                int* predictions = nullptr) {
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 100; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  ride.spoil = spoil;
  double worst = 0;
  for (int k = 0; k < 36; ++k) {
    ride.drive_scan();
    const auto predicted = ride.odometer.prediction();
    if (!predicted) continue;
    if (predictions) ++*predictions;
    const Covariance3& covariance = predicted->covariance;
    worst =
        std::max({worst, ride.error_m() / std::sqrt(std::max(covariance(0, 0), covariance(1, 1))),
                  std::abs(angle_between(ride.truth.theta_rad, predicted->T_map_base.theta_rad)) /
                      std::sqrt(covariance(2, 2))});
  }
  return worst;
}

TEST(Odometer, OneFutureReadingWithoutFixes_PredictionIsUnchanged) {
  for (const double ahead_s : {0.1, 0.2, 0.5, 1.0, 1.5, 1.9}) {
    int predictions = 0;
    const auto leap = [&](int i, OdometryReading& reading) {
      if (i == 140) reading.t_ns += from_seconds(ahead_s);
    };
    EXPECT_LT(worst_sigmas_while_blind(leap, &predictions), 5) << ahead_s;
    EXPECT_EQ(predictions, 36) << ahead_s;
  }
}

TEST(Odometer, ClockSetBackWithoutFixes_PredictionEnds) {
  for (const double back_s : {0.2, 0.5, 1.0, 1.9}) {
    const auto set_back = [&](int i, OdometryReading& reading) {
      if (i >= 140) reading.t_ns -= from_seconds(back_s);
    };
    EXPECT_LT(worst_sigmas_while_blind(set_back), 5) << back_s;
  }
}

TEST(Odometer, GyroInvertedOrBiased_NoPrediction) {
  const auto reversed = [](int, OdometryReading& reading) {
    reading.gyro_rad_s = -*reading.gyro_rad_s;
  };
  const auto off = [](int, OdometryReading& reading) { *reading.gyro_rad_s += 1; };
  for (const auto& spoil : {std::function(reversed), std::function(off)}) {
    int predictions = 0;
    worst_sigmas_while_blind(spoil, &predictions);
    EXPECT_LT(predictions, 36 / 2);
  }
}

TEST(Odometer, StuckWheel_IsRejected) {
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 100; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  EXPECT_TRUE(ride.odometer.summary().healthy);
  std::optional<std::int64_t> frozen;
  ride.spoil = [&](int, OdometryReading& reading) {
    if (!frozen) frozen = reading.left;
    reading.left = frozen;
  };
  int trusted = 0;
  for (int k = 0; k < 36; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
    trusted += ride.odometer.summary().healthy;
  }
  EXPECT_LT(trusted, 12);
  EXPECT_NEAR(ride.odometer.summary().parameters.left_scale, 0.01, 0.005);
}

}  // namespace
}  // namespace cornerd::core
