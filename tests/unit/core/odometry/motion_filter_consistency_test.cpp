// SPDX-License-Identifier: MIT
// Consistency tests that take many robots or steps, and minutes in an emulator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <Eigen/Eigenvalues>

#include "core/odometry/motion_filter.hpp"
#include "filtered_drive.hpp"

namespace cornerd::core {
namespace {

using testing::config_with_counts_of_5_mm;
using testing::nominal_errors;
using testing::switched_on;
using Drive = testing::FilteredDrive;

/// Normalized estimation error squared: 3 in the mean where the covariance is consistent. Each
/// robot's errors are drawn from the filter's priors.
double mean_nees(double taught_s, double blind_s, bool with_gyro, double noisier = 1,
                 const OdometryConfig& config = switched_on()) {
  double sum = 0;
  constexpr int kRobots = 100;
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
    std::mt19937_64 random(seed);
    random.discard(1000);  // decorrelates similar seeds
    std::normal_distribution<double> normal;
    testing::RobotErrors errors = nominal_errors();
    errors.left_scale = config.noise.wheel_scale * normal(random);
    errors.right_scale = config.noise.wheel_scale * normal(random);
    errors.track_scale = config.noise.track_scale * normal(random);
    errors.gyro_scale = config.noise.gyro_scale * normal(random);
    errors.gyro_bias_rad_s = config.noise.gyro_bias_rad_s * normal(random);
    errors.wheel_m_per_sqrt_m *= noisier;
    errors.gyro_rad_s_per_sqrt_hz *= noisier;
    Drive drive(config, errors, seed);
    drive.drive(taught_s, true, with_gyro);
    drive.drive(blind_s, false, with_gyro);
    sum += drive.nees();
  }
  return sum / kRobots;
}

TEST(MotionFilter, PredictedCovariance_IsConsistent) {
  // The mean of 100 is uncertain by 0.25. The filter models more noise than these robots have
  // (scrub, random walks of scales): a conservative covariance passes, an overconfident one does
  // not. Before any estimation, scales off by several percent are nonlinear.
  struct Case {
    double taught_s;
    double blind_s;
    double limit;
  };
  for (const auto& [taught_s, blind_s, limit] :
       {Case{0, 1, 4.2}, Case{5, 2, 3.6}, Case{30, 5, 3.6}, Case{30, 20, 3.6}}) {
    for (const bool with_gyro : {true, false}) {
      const double nees = mean_nees(taught_s, blind_s, with_gyro);
      EXPECT_LT(nees, limit) << taught_s << ' ' << blind_s << ' ' << with_gyro;
      EXPECT_GT(nees, 1.0) << taught_s << ' ' << blind_s << ' ' << with_gyro;
      RecordProperty("nees_" + std::to_string(lround(taught_s)) + "_" +
                         std::to_string(lround(blind_s)) + (with_gyro ? "_gyro" : "_wheels"),
                     std::to_string(nees));
    }
  }
}

TEST(MotionFilter, WrongNoiseModel_IsCorrectedByFixes) {
  // With the configured noise the values would be 9 and 0.9.
  for (const bool with_gyro : {true, false}) {
    const double noisy = mean_nees(30, 5, with_gyro, std::sqrt(3.0));
    EXPECT_LT(noisy, 4.2) << with_gyro;
    EXPECT_GT(noisy, 2.2) << with_gyro;
    const double quiet = mean_nees(30, 5, with_gyro, std::sqrt(0.3));
    EXPECT_LT(quiet, 3.6) << with_gyro;
    // Without a gyro the filter allows for fixes that are deskewed by the wheels; these are not.
    EXPECT_GT(quiet, with_gyro ? 1.6 : 0.5);
    RecordProperty(with_gyro ? "nees_gyro" : "nees_wheels",
                   std::to_string(noisy) + ", " + std::to_string(quiet));
  }
}

TEST(MotionFilter, CoarseCounts_CovarianceIsConsistent) {
  for (const bool with_gyro : {true, false}) {
    const double nees = mean_nees(15, 3, with_gyro, 1, config_with_counts_of_5_mm());
    EXPECT_LT(nees, 3.6) << with_gyro;
    EXPECT_GT(nees, 1.5) << with_gyro;
    RecordProperty(with_gyro ? "nees_gyro" : "nees_wheels", std::to_string(nees));
  }
}

TEST(MotionFilter, AnyMotion_CovarianceStaysPositiveDefinite) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  MotionFilter filter(switched_on());
  filter.set_pose({}, Covariance3::Identity() * 1e-6, {});
  for (int i = 0; i < 20000; ++i) {
    OdometryIncrement step;
    step.to_ns = static_cast<TimeNs>(random() % 1'000'000'000) + 1;
    step.left_m = normal(random);
    step.right_m = normal(random);
    step.gyro_rad = normal(random) * 10;
    step.has_gyro = random() % 2 == 0;
    step.is_gap = random() % 50 == 0;
    filter.add(step);
    filter.advance();
    const Pose2 anywhere{normal(random), normal(random), normal(random)};
    if (random() % 5 == 0) filter.correct(anywhere, Covariance3::Identity() * 1e-4, {});
    if (random() % 50 == 0) filter.set_pose(anywhere, Covariance3::Identity() * 1e-6, {});
    ASSERT_TRUE(filter.pose().translation().allFinite());
    const Eigen::SelfAdjointEigenSolver<MotionFilter::Matrix> values(filter.covariance());
    const double largest = values.eigenvalues().maxCoeff();
    ASSERT_GT(values.eigenvalues().minCoeff(), -1e-9 * std::max(1.0, largest)) << i;
  }
}

}  // namespace
}  // namespace cornerd::core
