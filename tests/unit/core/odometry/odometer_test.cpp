// SPDX-License-Identifier: MIT
#include "core/odometry/odometer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "../fixtures.hpp"
#include "driven_robot.hpp"
#include "odometer_drive.hpp"

namespace cornerd::core {
namespace {

constexpr double kScan_s = 0.14;
using testing::kFixCovariance;
using testing::OdometerDrive;
using testing::switched_on;

TEST(Odometer, BeforeFirstFix_NoPrediction) {
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 5; ++k) ride.drive_scan();
  EXPECT_FALSE(ride.odometer.prediction());
  EXPECT_TRUE(ride.odometer.has_motion());
}

TEST(Odometer, PredictLatest_IsCurrentPose) {
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 300; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  double variance_m2 = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose2 now = ride.go_on();
    const auto ahead = ride.odometer.predict_latest();
    ASSERT_TRUE(ahead);
    EXPECT_LT((ahead->T_map_base.translation() - now.translation()).norm(), 0.01) << i;
    EXPECT_LT(std::abs(angle_between(ahead->T_map_base.theta_rad, now.theta_rad)), 0.01) << i;
    EXPECT_GT(ahead->covariance.trace(), variance_m2) << i;
    variance_m2 = ahead->covariance.trace();
  }
}

TEST(Odometer, PredictLatest_IsStartOfNextScan) {
  // Counts predicted reading by reading equal those that the scan consumes.
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 20; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  ride.go_on();
  ASSERT_TRUE(ride.odometer.predict_latest());
  for (int i = 0; i < 9; ++i) ride.go_on();
  const PredictedPose ahead = ride.odometer.predict_latest().value();
  ride.odometer.advance(ahead.t_ns - 1000, ahead.t_ns, ahead.t_ns + 1000);
  const PredictedPose reached = ride.odometer.prediction().value();
  EXPECT_NEAR(reached.T_map_base.x_m, ahead.T_map_base.x_m, 1e-9);
  EXPECT_NEAR(reached.T_map_base.y_m, ahead.T_map_base.y_m, 1e-9);
  EXPECT_TRUE(reached.covariance.isApprox(ahead.covariance, 1e-6));
}

TEST(Odometer, PredictLatest_BeforeFirstFix_IsNull) {
  OdometerDrive ride(switched_on());
  ride.drive_scan();
  ride.go_on();
  EXPECT_FALSE(ride.odometer.predict_latest());
}

TEST(Odometer, BetweenFixes_PredictsMiddleOfScan) {
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 300; ++k) {
    ride.drive_scan();
    if (k > 50) {
      ASSERT_LT(ride.error_m(), 0.004) << k;
    }
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  EXPECT_EQ(ride.odometer.summary().rejected_fixes, 0U);
  EXPECT_TRUE(ride.odometer.summary().healthy);
  EXPECT_NEAR(ride.odometer.summary().parameters.gyro_bias_rad_s, 0.01, 0.001);
}

TEST(Odometer, LateOrSparseReadings_CountOnce) {
  for (const auto& [late, every] : {std::pair{8, 1}, {0, 17}, {8, 17}}) {
    OdometerDrive ride(switched_on(), late, every);
    for (int k = 0; k < 100; ++k) {
      ride.drive_scan();
      if (k < 60) ride.odometer.correct(ride.truth, kFixCovariance);
    }
    // Six seconds without fixes. The last reading is up to 0.25 s old, and motion since then is
    // extrapolated.
    EXPECT_LT(ride.error_m(), 0.12) << late << ' ' << every;
    EXPECT_EQ(ride.odometer.summary().counters.jumps, 0U);
  }
}

TEST(Odometer, NoFixes_PredictsForMaxExtrapolation) {
  OdometryConfig config = switched_on();
  config.max_extrapolation_s = 3;
  OdometerDrive ride(config);
  for (int k = 0; k < 200; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  for (int k = 1; k <= 40; ++k) {
    ride.drive_scan();
    ASSERT_EQ(ride.odometer.prediction().has_value(), k * kScan_s <= 3) << k;
    if (k * kScan_s <= 3) {
      EXPECT_LT(ride.error_m(), 0.02);
    }
  }
}

TEST(Odometer, ReadingsStop_PredictionEnds) {
  OdometerDrive ride(switched_on());
  for (int k = 0; k < 20; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  for (int k = 0; k < 4; ++k) ride.drive_scan(/*readings=*/false);
  EXPECT_FALSE(ride.odometer.prediction());
  EXPECT_FALSE(ride.odometer.has_motion());
  EXPECT_FALSE(ride.odometer.summary().present);
  for (int k = 0; k < 20; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  EXPECT_TRUE(ride.odometer.prediction());
}

TEST(Odometer, StationaryRobot_WheelScalesAreUnchanged) {
  Odometer odometer(switched_on());
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  TimeNs now_ns = 0;
  for (int scan = 0; scan < 400; ++scan) {
    const TimeNs start_ns = now_ns;
    for (int i = 0; i < 7; ++i) {
      now_ns += 20'000'000;
      // Four times the configured noise.
      odometer.add({now_ns, 0, 0, 0.01 + 0.007 * normal(random), now_ns});
    }
    odometer.advance(start_ns, start_ns + 70'000'000, now_ns);
    odometer.correct(Pose2{1 + 3e-4 * normal(random), 2, 0.3 + 3e-4 * normal(random)},
                     Covariance3::Identity() * 1e-7 + odometer.deskew_covariance());
  }
  const OdometryParameters learned = odometer.summary().parameters;
  EXPECT_NEAR(learned.left_scale, 0, 0.005);
  EXPECT_NEAR(learned.right_scale, 0, 0.005);
  EXPECT_NEAR(learned.track_scale, 0, 0.005);
  EXPECT_NEAR(learned.gyro_scale, 0, 0.005);
  EXPECT_NEAR(learned.gyro_bias_rad_s, 0.01, 0.002);
}

TEST(Odometer, JitteringTimes_ScalesDoNotDrift) {
  OdometerDrive ride(switched_on());
  std::mt19937_64 random(5);
  std::normal_distribution<double> jitter_s(0, 0.002);
  ride.spoil = [&](int, OdometryReading& reading) {
    reading.t_ns += from_seconds(std::clamp(jitter_s(random), -0.004, 0.004));
  };
  for (int k = 0; k < 400; ++k) {
    ride.drive_scan();
    ride.odometer.correct(ride.truth, kFixCovariance);
  }
  const OdometryParameters learned = ride.odometer.summary().parameters;
  EXPECT_NEAR(learned.track_scale, 0, 0.02);
  EXPECT_NEAR(learned.gyro_scale, 0, 0.02);
  EXPECT_NEAR(learned.left_scale, 0.01, 0.01);
}

TEST(Odometer, AfterForget_NeedsFix) {
  OdometerDrive ride(switched_on());
  ride.drive_scan();
  ride.odometer.correct(ride.truth, kFixCovariance);
  ride.odometer.forget();
  ride.drive_scan();
  EXPECT_FALSE(ride.odometer.prediction());
}

TEST(Odometer, Disabled_DoesNothing) {
  OdometerDrive ride(OdometryConfig{});
  ride.drive_scan();
  ride.odometer.correct(ride.truth, kFixCovariance);
  ride.drive_scan();
  EXPECT_FALSE(ride.odometer.has_motion());
  EXPECT_FALSE(ride.odometer.prediction());
}

TEST(Odometer, ScanTakenInMotion_IsDeskewed) {
  const auto map = testing::make_map(testing::rectangular_room(4, 3));
  const OdometryConfig config = switched_on();
  testing::DrivenRobot robot(config.geometry, {});
  Odometer odometer(config);
  const Pose2 T_base_lidar{0.05, -0.02, 0.3};
  constexpr double kSpeed_m_s = 0.5;
  constexpr double kRate_rad_s = 2;
  for (int i = 0; i < 15; ++i) odometer.add(robot.drive(0.01, kSpeed_m_s, kRate_rad_s));

  // Each ray from the robot's pose at its time; the middle of the scan is at (1, 1) in the room.
  const TimeNs start_ns = 15'000'000;
  const auto pose_at = [&](double t_s) {
    const double rotation_rad = kRate_rad_s * (t_s - 0.075);
    const double chord_m = 2 * kSpeed_m_s / kRate_rad_s * std::sin(rotation_rad / 2);
    return Pose2{1, 1, 0.7} * arc(chord_m, rotation_rad);
  };
  Scan scan;
  for (int i = 0; i < 400; ++i) {
    Sample sample;
    sample.t_ns = start_ns + i * 300'000;
    sample.bearing_rad = static_cast<float>(normalize_angle(3 - kTwoPi * i / 400));
    const Pose2 T_map_lidar = pose_at(to_seconds(sample.t_ns)) * T_base_lidar;
    sample.range_m = static_cast<float>(map->range_along(
        T_map_lidar.translation(), T_map_lidar.theta_rad + sample.bearing_rad, 12));
    scan.add(sample);
  }
  Scan deskewed;
  odometer.advance(start_ns, 75'000'000, scan.end_ns());
  ASSERT_TRUE(odometer.deskew(scan, T_base_lidar, deskewed));
  ASSERT_EQ(deskewed.size(), scan.size());
  const Pose2 T_map_lidar = pose_at(0.075) * T_base_lidar;
  double worst_m = 0;
  for (const Sample& sample : deskewed.samples()) {
    const Vec2 point = T_map_lidar * (sample.range_m * unit_vector(sample.bearing_rad));
    const double off_m = std::min({std::abs(point.x()), std::abs(point.x() - 4),
                                   std::abs(point.y()), std::abs(point.y() - 3)});
    worst_m = std::max(worst_m, off_m);
  }
  EXPECT_LT(worst_m, 0.002);
}

}  // namespace
}  // namespace cornerd::core
