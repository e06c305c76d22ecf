// SPDX-License-Identifier: MIT
#include "core/odometry/fusion_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/odometry/reading_gate.hpp"
#include "driven_robot.hpp"

namespace cornerd::core {
namespace {

OdometryConfig config_of_a_small_robot() {
  OdometryConfig config;
  config.enabled = true;
  return config;
}

testing::RobotErrors usual_errors() {
  testing::RobotErrors errors;
  errors.left_scale = 0.015;
  errors.right_scale = 0.025;
  errors.gyro_scale = 0.02;
  errors.gyro_bias_rad_s = 0.01;
  errors.wheel_m_per_sqrt_m = OdometryNoise{}.wheel_m_per_sqrt_m;
  errors.gyro_rad_s_per_sqrt_hz = OdometryNoise{}.gyro_rad_s_per_sqrt_hz;
  return errors;
}

constexpr double kFixSigma_m = 0.002;
constexpr double kFixSigma_rad = 0.001;

/// A robot, its filter, and a lidar that says where it is every 0.14 s.
class Drive {
 public:
  Drive(const OdometryConfig& config, const testing::RobotErrors& errors, std::uint64_t seed)
      : robot_(config.geometry, errors, seed), gate_(config), filter_(config) {
    fix_covariance_ = Eigen::Vector3d(kFixSigma_m * kFixSigma_m, kFixSigma_m * kFixSigma_m,
                                      kFixSigma_rad * kFixSigma_rad)
                          .asDiagonal();
    filter_.set_pose(measured(), fix_covariance_);
  }

  void drive(double duration_s, bool with_fixes, bool with_gyro = true) {
    for (int i = 0; i < std::lround(duration_s * 50); ++i, ++ticks_) {
      const testing::Rates rates = testing::lively_drive(0.02 * ticks_);
      OdometryReading reading = robot_.drive(0.02, rates.speed_m_s, rates.rate_rad_s);
      if (!with_gyro) reading.gyro_rad_s.reset();
      if (const auto step = gate_.add(reading, std::nullopt)) filter_.predict(*step);
      if (with_fixes && ticks_ % 7 == 0) correct();
    }
  }
  bool correct() { return filter_.correct(measured(), fix_covariance_); }

  Pose2 measured() {
    const Pose2& truth = robot_.truth();
    return {truth.x_m + kFixSigma_m * robot_.normal(), truth.y_m + kFixSigma_m * robot_.normal(),
            normalize_angle(truth.theta_rad + kFixSigma_rad * robot_.normal())};
  }
  Eigen::Vector3d error() const {
    const Pose2 pose = filter_.pose();
    const Pose2& truth = robot_.truth();
    return {pose.x_m - truth.x_m, pose.y_m - truth.y_m,
            angle_between(truth.theta_rad, pose.theta_rad)};
  }
  double nees() const {
    return error().dot(Eigen::LLT<Eigen::Matrix3d>(filter_.pose_covariance()).solve(error()));
  }
  FusionFilter& filter() { return filter_; }
  testing::DrivenRobot& robot() { return robot_; }

 private:
  testing::DrivenRobot robot_;
  ReadingGate gate_;
  FusionFilter filter_;
  Covariance3 fix_covariance_;
  int ticks_ = 0;
};

TEST(FusionFilter, ThirtySecondsWithFixes_TeachScalesAndBias) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const testing::RobotErrors errors = usual_errors();
    Drive drive(config_of_a_small_robot(), errors, seed);
    drive.drive(30, true);
    const LearnedOdometry learned = drive.filter().learned();
    EXPECT_NEAR(learned.left_scale, errors.left_scale, 0.003) << seed;
    EXPECT_NEAR(learned.right_scale, errors.right_scale, 0.003) << seed;
    EXPECT_NEAR(learned.gyro_scale, errors.gyro_scale, 0.003) << seed;
    EXPECT_NEAR(learned.track_scale, 0, 0.004) << seed;
    EXPECT_NEAR(learned.gyro_bias_rad_s, errors.gyro_bias_rad_s, 0.001) << seed;
  }
}

TEST(FusionFilter, FiveSecondsBlindAfterThirty_StayWithinThreeCentimetres) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drive drive(config_of_a_small_robot(), usual_errors(), seed);
    drive.drive(30, true);
    drive.drive(5, false);
    EXPECT_LT(drive.error().head<2>().norm(), 0.03) << seed;
    EXPECT_LT(std::abs(drive.error().z()), radians(1)) << seed;
  }
}

/// Normalised estimation error squared: 3 in the mean where the covariance is honest. The errors of
/// each robot are drawn from what the filter is told of them.
double mean_nees(double taught_s, double blind_s, bool with_gyro, double noisier = 1,
                 const OdometryConfig& config = config_of_a_small_robot()) {
  double sum = 0;
  constexpr int kRobots = 100;
  for (std::uint64_t seed = 1; seed <= kRobots; ++seed) {
    std::mt19937_64 random(seed);
    random.discard(1000);  // equal beginnings of seeds that are alike
    std::normal_distribution<double> normal;
    testing::RobotErrors errors = usual_errors();
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

TEST(FusionFilter, PredictedCovariance_IsHonest) {
  // The mean of 100 is off by 0.25 itself. The filter reckons with more noise than these robots
  // have (scrub, scales that wander): it may be cautious, never bold. Where nothing is learned yet,
  // scales that are off by several percent are not quite linear.
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

TEST(FusionFilter, WheelsAndGyroNoisierOrQuieterThanTold_AreFoundOutByTheFixes) {
  // Taken as told, they would give 9 and 0.9.
  for (const bool with_gyro : {true, false}) {
    const double noisy = mean_nees(60, 5, with_gyro, std::sqrt(3.0));
    EXPECT_LT(noisy, 4.2) << with_gyro;
    EXPECT_GT(noisy, 2.2) << with_gyro;
    const double quiet = mean_nees(60, 5, with_gyro, std::sqrt(0.3));
    EXPECT_LT(quiet, 3.6) << with_gyro;
    EXPECT_GT(quiet, 1.6) << with_gyro;
    RecordProperty(with_gyro ? "nees_gyro" : "nees_wheels",
                   std::to_string(noisy) + ", " + std::to_string(quiet));
  }
}

OdometryConfig config_with_counts_of_5_mm() {
  OdometryConfig config = config_of_a_small_robot();
  config.geometry.counts_per_turn = 40;
  return config;
}

TEST(FusionFilter, CoarseCounts_DoNotAddUp) {
  // The way from count to count is off by 1.4 mm at each end, however many lie in between.
  const OdometryConfig config = config_with_counts_of_5_mm();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drive drive(config, usual_errors(), seed);
    drive.drive(30, true);
    EXPECT_NEAR(drive.filter().learned().left_scale, 0.015, 0.004) << seed;
    EXPECT_NEAR(drive.filter().learned().right_scale, 0.025, 0.004) << seed;
    drive.drive(5, false);
    EXPECT_LT(drive.error().head<2>().norm(), 0.02) << seed;
    EXPECT_LT(std::sqrt(drive.filter().pose_covariance()(0, 0)), 0.02) << seed;
  }
}

TEST(FusionFilter, CoarseCounts_LeaveTheCovarianceHonest) {
  for (const bool with_gyro : {true, false}) {
    const double nees = mean_nees(15, 3, with_gyro, 1, config_with_counts_of_5_mm());
    EXPECT_LT(nees, 3.6) << with_gyro;
    EXPECT_GT(nees, 1.5) << with_gyro;
    RecordProperty(with_gyro ? "nees_gyro" : "nees_wheels", std::to_string(nees));
  }
}

TEST(FusionFilter, WithFixes_IsBetterThanTheFixes) {
  double squares_m2 = 0;
  int count = 0;
  Drive drive(config_of_a_small_robot(), usual_errors(), 3);
  drive.drive(20, true);
  for (int i = 0; i < 300; ++i, ++count) {
    drive.drive(0.14, true);
    squares_m2 += drive.error().head<2>().squaredNorm();
  }
  EXPECT_LT(std::sqrt(squares_m2 / count), kFixSigma_m * std::sqrt(2.0));
}

TEST(FusionFilter, AWheelThatSpinsFree_DoesNotTurnTheRobot) {
  const OdometryConfig config = config_of_a_small_robot();
  Drive drive(config, usual_errors(), 4);
  drive.drive(30, true);
  const LearnedOdometry before = drive.filter().learned();
  const Pose2 start = drive.filter().pose();
  const std::uint64_t slips = drive.filter().slips();
  MotionStep slip;
  slip.to_ns = kNsPerSecond / 50;
  slip.right_m = 0.02;
  slip.has_gyro = true;
  slip.gyro_rad = before.gyro_bias_rad_s * slip.duration_s();
  for (int i = 0; i < 25; ++i) drive.filter().predict(slip);
  EXPECT_EQ(drive.filter().slips() - slips, 25U);
  EXPECT_LT(std::abs(angle_between(start.theta_rad, drive.filter().pose().theta_rad)), 0.02);
  EXPECT_NEAR(drive.filter().learned().right_scale, before.right_scale, 0.002);
  EXPECT_NEAR(drive.filter().learned().gyro_bias_rad_s, before.gyro_bias_rad_s, 0.001);
  EXPECT_LT((drive.filter().pose().translation() - start.translation()).norm(), 0.03);
  EXPECT_TRUE(drive.correct());  // half a metre of spinning makes it doubt enough
}

TEST(FusionFilter, AFixFromElsewhere_IsRefusedAndChangesNothing) {
  Drive drive(config_of_a_small_robot(), usual_errors(), 5);
  drive.drive(10, true);
  const FusionFilter before = drive.filter();
  Pose2 elsewhere = drive.robot().truth();
  elsewhere.x_m += 0.5;
  EXPECT_FALSE(drive.filter().correct(elsewhere, Covariance3::Identity() * 1e-6));
  EXPECT_EQ(drive.filter().state(), before.state());
  EXPECT_EQ(drive.filter().covariance(), before.covariance());
}

TEST(FusionFilter, AHole_LetsTheDoubtGrowAndTheLearnedStay) {
  Drive drive(config_of_a_small_robot(), usual_errors(), 6);
  drive.drive(30, true);
  const LearnedOdometry before = drive.filter().learned();
  MotionStep hole;
  hole.to_ns = 2 * kNsPerSecond;
  hole.is_hole = true;
  drive.filter().predict(hole);
  EXPECT_GT(drive.filter().pose_covariance()(0, 0), 0.25);
  EXPECT_EQ(drive.filter().learned().left_scale, before.left_scale);
}

TEST(FusionFilter, AnyMotion_KeepsTheCovarianceOne) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  FusionFilter filter(config_of_a_small_robot());
  filter.set_pose({}, Covariance3::Identity() * 1e-6);
  for (int i = 0; i < 20000; ++i) {
    MotionStep step;
    step.to_ns = static_cast<TimeNs>(random() % 1'000'000'000) + 1;
    step.left_m = normal(random);
    step.right_m = normal(random);
    step.gyro_rad = normal(random) * 10;
    step.has_gyro = random() % 2 == 0;
    step.is_hole = random() % 50 == 0;
    filter.predict(step);
    const Pose2 anywhere{normal(random), normal(random), normal(random)};
    if (random() % 5 == 0) filter.correct(anywhere, Covariance3::Identity() * 1e-4);
    if (random() % 50 == 0) filter.set_pose(anywhere, Covariance3::Identity() * 1e-6);
    ASSERT_TRUE(filter.state().allFinite());
    const Eigen::SelfAdjointEigenSolver<FusionFilter::Matrix> values(filter.covariance());
    const double largest = values.eigenvalues().maxCoeff();
    ASSERT_GT(values.eigenvalues().minCoeff(), -1e-9 * std::max(1.0, largest)) << i;
  }
}

}  // namespace
}  // namespace cornerd::core
