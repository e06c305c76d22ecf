// SPDX-License-Identifier: MIT
// Predictions with faulty wheels, gyro or clock: absent, or with a consistent covariance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "core/odometry/odometer.hpp"
#include "odometer_drive.hpp"

namespace cornerd::core {
namespace {

using testing::kFixCovariance;
using testing::OdometerDrive;
using testing::switched_on;

struct Carried {
  int predictions = 0;
  int wrong = 0;  ///< by more than five degrees
  double mean_error_squared = 0;
};

/// Fixes in all scans but `blind` of them after every `seen`; collects the predictions in those.
Carried carried_on(OdometerDrive& ride, int seen, int blind, int times) {
  Carried carried;
  for (int i = 0; i < times; ++i) {
    for (int k = 0; k < seen; ++k) {
      ride.drive_scan();
      ride.odometer.correct(ride.truth, kFixCovariance);
    }
    for (int k = 0; k < blind; ++k) {
      ride.drive_scan();
      const auto predicted = ride.odometer.prediction();
      if (!predicted) continue;
      const Eigen::Vector3d error(
          predicted->T_map_base.x_m - ride.truth.x_m, predicted->T_map_base.y_m - ride.truth.y_m,
          angle_between(ride.truth.theta_rad, predicted->T_map_base.theta_rad));
      ++carried.predictions;
      carried.wrong += std::abs(error[2]) > radians(5);
      carried.mean_error_squared += error.dot(predicted->covariance.inverse() * error);
    }
  }
  carried.mean_error_squared /= std::max(1, carried.predictions);
  return carried;
}

TEST(OdometerDoubt, GyroInvertedFromStart_NoPrediction) {
  OdometerDrive ride(switched_on());
  ride.spoil = [](int, OdometryReading& reading) { reading.gyro_rad_s = -*reading.gyro_rad_s; };
  EXPECT_EQ(carried_on(ride, 1, 1, 300).wrong, 0);
}

TEST(OdometerDoubt, GyroSticks_NoPredictionInRotations) {
  OdometerDrive ride(switched_on());
  EXPECT_GT(carried_on(ride, 1, 1, 60).predictions, 55);
  std::optional<double> stuck;
  ride.spoil = [&](int, OdometryReading& reading) {
    if (!stuck) stuck = reading.gyro_rad_s;
    reading.gyro_rad_s = stuck;
  };
  const Carried carried = carried_on(ride, 1, 1, 120);
  EXPECT_EQ(carried.wrong, 0);
  EXPECT_GT(carried.predictions, 60) << "the wheels alone go on";
}

TEST(OdometerDoubt, WheelSlipWithoutGyro_CovarianceIsConsistent) {
  OdometerDrive ride(switched_on());
  std::mt19937_64 random(5);
  std::int64_t slipped = 0;
  ride.spoil = [&](int, OdometryReading& reading) {
    reading.gyro_rad_s.reset();
    // 0.1 rad at a time, every ten seconds.
    if (std::uniform_real_distribution<>(0, 1)(random) < 0.001) slipped += 113;
    *reading.left += slipped;
  };
  carried_on(ride, 10, 0, 60);
  const Carried carried = carried_on(ride, 20, 20, 60);
  EXPECT_GT(carried.predictions, 600);
  EXPECT_LT(carried.mean_error_squared, 6);
}

}  // namespace
}  // namespace cornerd::core
