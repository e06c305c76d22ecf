// SPDX-License-Identifier: MIT
// The localizer with wheels and a gyro: deskewed scans, and poses without the lidar.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/localizer.hpp"
#include "core/odometry/odometry_increment.hpp"
#include "fixtures.hpp"
#include "odometry/driven_robot.hpp"

namespace cornerd::core {
namespace {

constexpr double kScanDuration_s = 0.14;

/// A robot on a circle in the L-shaped room with lidar and wheels.
class CircleDrive {
 public:
  CircleDrive(double speed_m_s, double rate_rad_s, double max_extrapolation_s = 10,
              bool publish = false)
      : map_(testing::make_map(testing::l_shaped_room())),
        config_(config(max_extrapolation_s, publish)),
        localizer_(map_, config_),
        robot_({}, errors(), 5),
        speed_m_s_(speed_m_s),
        rate_rad_s_(rate_rad_s) {}

  const PoseEstimate& drive_scan(bool covered = false, const std::optional<Pose2>& elsewhere = {}) {
    testing::ScanOptions options;
    options.scan_s = kScanDuration_s;
    options.start_ns = robot_.now_ns();
    options.motion = Twist2{speed_m_s_, 0, rate_rad_s_};
    options.missing_share = covered ? 1 : 0;
    for (int i = 0; i < 14; ++i) {
      const OdometryReading reading = robot_.drive(0.01, speed_m_s_, rate_rad_s_);
      const PoseEstimate* between = localizer_.add(reading);
      if (between != nullptr) between_.push_back({*between, Pose2{1.2, 0.9, 0.3} * robot_.truth()});
      if (i == 6) truth_ = Pose2{1.2, 0.9, 0.3} * robot_.truth();
    }
    const Scan scan = source_.take(*map_, elsewhere.value_or(truth_), options);
    if (turned_round_) listed_.assign_reversed(scan);
    const ScanResult& result = localizer_.step(turned_round_ ? listed_ : scan);
    odometry_ = result.odometry;
    return result.pose;
  }
  void set_pose(const Pose2& T_map_base) { localizer_.set_pose(T_map_base); }
  /// A reload: one with another config goes on.
  void replace_localizer(void (*change)(LocalizerConfig&)) {
    change(config_);
    Localizer next(map_, config_);
    next.resume_odometry(localizer_);
    localizer_ = std::move(next);
  }
  /// From now on bearings come counter-clockwise, as ROS drivers give those of clockwise lidars.
  void turn_order_round() { turned_round_ = true; }
  double error_m(const PoseEstimate& pose) const {
    return (pose.T_map_base.translation() - truth_.translation()).norm();
  }
  const OdometrySummary& odometry() const { return odometry_; }
  struct Between {
    PoseEstimate pose;
    Pose2 truth;
  };
  const std::vector<Between>& between() const { return between_; }

 private:
  static LocalizerConfig config(double max_extrapolation_s, bool publish) {
    LocalizerConfig config;
    config.odometry.enabled = true;
    config.odometry.max_extrapolation_s = max_extrapolation_s;
    config.odometry.publish_predictions = publish;
    return config;
  }
  static testing::RobotErrors errors() {
    testing::RobotErrors errors;
    errors.left_scale = 0.01;
    errors.gyro_bias_rad_s = 0.01;
    return errors;
  }

  std::shared_ptr<const WallMap> map_;
  LocalizerConfig config_;
  Localizer localizer_;
  testing::DrivenRobot robot_;
  testing::ScanSource source_{91};
  bool turned_round_ = false;
  Scan listed_;
  double speed_m_s_;
  double rate_rad_s_;
  Pose2 truth_;
  OdometrySummary odometry_;
  std::vector<Between> between_;
};

TEST(LocalizerWithOdometry, PublishPredictions_PosesBetweenScans) {
  CircleDrive drive(0.4, 0.8, 10, true);
  for (int k = 0; k < 40; ++k) drive.drive_scan();
  EXPECT_TRUE(drive.between().size() > 39 * 13);
  std::uint64_t seq = 0;
  for (const CircleDrive::Between& between : drive.between()) {
    EXPECT_EQ(between.pose.state, PoseState::kPredicted);
    EXPECT_GT(between.pose.seq, seq);
    seq = between.pose.seq;
    EXPECT_GT(between.pose.age_s, 0);
    EXPECT_LT(between.pose.age_s, 2 * kScanDuration_s);
    EXPECT_LT((between.pose.T_map_base.translation() - between.truth.translation()).norm(), 0.02);
  }
}

TEST(LocalizerWithOdometry, PublishPredictionsOff_NoPosesBetweenScans) {
  CircleDrive drive(0.4, 0.8);
  for (int k = 0; k < 3; ++k) drive.drive_scan();
  EXPECT_TRUE(drive.between().empty());
}

TEST(LocalizerWithOdometry, KidnappedRobot_IsPredictedFromItsNewPose) {
  CircleDrive drive(0.4, 0.8, 10, true);
  for (int k = 0; k < 10; ++k) drive.drive_scan();
  const Pose2 elsewhere{0.5, 2.4, -2};
  const PoseEstimate& pose = drive.drive_scan(false, elsewhere);
  ASSERT_EQ(pose.state, PoseState::kFix);
  EXPECT_LT((pose.T_map_base.translation() - elsewhere.translation()).norm(), 0.02);
  const std::size_t before = drive.between().size();
  const Pose2 one_scan_later = elsewhere * arc(0.4 * kScanDuration_s, 0.8 * kScanDuration_s);
  drive.drive_scan(false, one_scan_later);
  EXPECT_EQ(drive.between().size(), before) << "until the lidar and the wheels agree again";
  drive.drive_scan(false, one_scan_later);
  ASSERT_GT(drive.between().size(), before);
  for (std::size_t i = before; i < drive.between().size(); ++i) {
    const Pose2& predicted = drive.between()[i].pose.T_map_base;
    EXPECT_LT((predicted.translation() - elsewhere.translation()).norm(), 0.2) << i;
  }
}

TEST(LocalizerWithOdometry, FastSpin_IsFixFromSecondScan) {
  CircleDrive drive(0.4, 2.5);
  drive.drive_scan();
  for (int k = 0; k < 40; ++k) {
    const PoseEstimate& pose = drive.drive_scan();
    ASSERT_EQ(pose.state, PoseState::kFix) << k;
    EXPECT_LT(drive.error_m(pose), 0.01) << k;
  }
}

TEST(LocalizerWithOdometry, BearingsInOppositeOrder_FoundOutByTurning) {
  CircleDrive drive(0.4, 2.5);
  drive.turn_order_round();
  double worst_m = 0;
  for (int k = 0; k < 60; ++k) {
    const PoseEstimate& pose = drive.drive_scan();
    if (k < 20) continue;
    ASSERT_EQ(pose.state, PoseState::kFix) << k;
    worst_m = std::max(worst_m, drive.error_m(pose));
  }
  EXPECT_LT(worst_m, 0.01);
}

TEST(LocalizerWithOdometry, CoveredLidar_IsPredictedWithGrowingCovariance) {
  CircleDrive drive(0.3, 0.8);
  for (int k = 0; k < 100; ++k) drive.drive_scan();
  double last_m2 = 0;
  for (int k = 1; k <= 35; ++k) {
    const PoseEstimate& pose = drive.drive_scan(/*covered=*/true);
    ASSERT_EQ(pose.state, PoseState::kPredicted) << k;
    EXPECT_NEAR(pose.age_s, k * kScanDuration_s, 0.02);
    EXPECT_LT(drive.error_m(pose), 0.03);
    EXPECT_GT(pose.covariance.trace(), last_m2);
    last_m2 = pose.covariance.trace();
    EXPECT_TRUE(pose.room);
    EXPECT_TRUE(pose.alternatives.empty());
  }
  EXPECT_EQ(drive.drive_scan().state, PoseState::kFix);
}

TEST(LocalizerWithOdometry, AfterMaxExtrapolation_IsLost) {
  CircleDrive drive(0.3, 0.8, /*max_extrapolation_s=*/1);
  for (int k = 0; k < 20; ++k) drive.drive_scan();
  for (int k = 1; k <= 12; ++k) {
    EXPECT_EQ(drive.drive_scan(/*covered=*/true).state,
              k * kScanDuration_s <= 1 ? PoseState::kPredicted : PoseState::kLost)
        << k;
  }
}

TEST(LocalizerWithOdometry, KidnappedRobot_NotPredictedAgainstScan) {
  CircleDrive drive(0, 0.001);
  for (int k = 0; k < 20; ++k) drive.drive_scan();
  const Pose2 elsewhere{2.2, 0.5, -2};
  for (int k = 0; k < 2; ++k) {
    const PoseEstimate& pose = drive.drive_scan(false, elsewhere);
    EXPECT_EQ(pose.state, PoseState::kFix);
    EXPECT_NEAR(pose.T_map_base.x_m, 2.2, 0.01);
  }
}

TEST(LocalizerWithOdometry, Summary_HasEstimatedParameters) {
  CircleDrive drive(0.3, 0.8);
  for (int k = 0; k < 200; ++k) drive.drive_scan();
  const OdometrySummary& odometry = drive.odometry();
  EXPECT_TRUE(odometry.enabled);
  EXPECT_TRUE(odometry.healthy);
  EXPECT_GT(odometry.fixes, 190U);
  // On one circle the wheels' scales, the bias and the gyro's scale are not observable separately.
  // The wheels move at 0.236 and 0.364 m/s.
  EXPECT_NEAR(
      (0.236 * odometry.parameters.left_scale + 0.364 * odometry.parameters.right_scale) / 0.6,
      0.01 * 0.236 / 0.6, 0.001);
}

TEST(LocalizerWithOdometry, WrongInitialPoses_AreNoEvidenceAboutTheWheels) {
  CircleDrive drive(0.3, 0.8);
  for (int k = 0; k < 200; ++k) {
    if (k % 2 == 0) drive.set_pose({0.3 + 0.1 * (k % 20), 0.5 + 0.1 * (k % 7), 0.7});
    ASSERT_EQ(drive.drive_scan().state, PoseState::kFix) << k;
  }
  EXPECT_EQ(drive.odometry().rejected_fixes, 0U);
  EXPECT_TRUE(drive.odometry().healthy);
  EXPECT_LT(drive.odometry().sigma.delay_s, 0.011) << "the readings' times are not in doubt";
}

TEST(LocalizerWithOdometry, AnotherPipelineOfTheSameRobot_GoesOnWithWhatWasLearned) {
  CircleDrive drive(0.3, 0.8);
  for (int k = 0; k < 200; ++k) drive.drive_scan();
  const OdometrySummary learned = drive.odometry();
  ASSERT_LT(learned.sigma.left_scale, 0.02);
  drive.replace_localizer([](LocalizerConfig& config) {
    config.odometry.publish_predictions = true;
    config.learn_walls = false;
  });
  EXPECT_EQ(drive.drive_scan().state, PoseState::kFix);
  EXPECT_NEAR(drive.odometry().parameters.left_scale, learned.parameters.left_scale, 1e-4);
  EXPECT_NEAR(drive.odometry().sigma.left_scale, learned.sigma.left_scale, 1e-4);
  EXPECT_TRUE(drive.odometry().present) << "the readings go on";
  EXPECT_GT(drive.odometry().counters.readings, learned.counters.readings);
}

TEST(LocalizerWithOdometry, AnotherRobotOrMount_LearnsAnew) {
  for (const auto& change :
       {+[](LocalizerConfig& config) { config.odometry.geometry.track_m *= 2; },
        +[](LocalizerConfig& config) { config.T_base_lidar.x_m += 0.1; }}) {
    CircleDrive drive(0.3, 0.8);
    for (int k = 0; k < 50; ++k) drive.drive_scan();
    drive.replace_localizer(change);
    drive.drive_scan();
    EXPECT_LE(drive.odometry().fixes, 1U) << "of its own scan";
  }
}

TEST(LocalizerWithOdometry, Forget_TakesReadingsOfAnyTime) {
  LocalizerConfig config;
  config.odometry.enabled = true;
  Localizer localizer(nullptr, config);
  const auto moves_at = [&](double t_s, std::int64_t counts) {
    const TimeNs t_ns = from_seconds(t_s);
    localizer.add({t_ns, counts, counts, std::nullopt, t_ns});
    return localizer.measured_motion().has_value();
  };
  EXPECT_FALSE(moves_at(10, 0));
  EXPECT_TRUE(moves_at(10.02, 20));
  localizer.forget_scans();
  EXPECT_TRUE(moves_at(10.04, 40)) << "the stream goes on";
  localizer.forget();
  EXPECT_FALSE(moves_at(1, 0));
  EXPECT_TRUE(moves_at(1.02, 20)) << "another stream";
}

TEST(Localizer, InitialPose_ResolvesSymmetry) {
  const auto map = testing::make_map(testing::two_equal_rooms());
  testing::ScanSource source(92);
  Localizer localizer(map, {});
  testing::ScanOptions options;
  ASSERT_EQ(localizer.step(source.take(*map, {6.8, 1.2, 0.3}, options)).pose.state,
            PoseState::kAmbiguous);
  localizer.set_pose({6.75, 1.25, 0.25});
  options.start_ns = 140'000'000;
  const PoseEstimate& pose = localizer.step(source.take(*map, {6.8, 1.2, 0.3}, options)).pose;
  ASSERT_EQ(pose.state, PoseState::kTracking);
  EXPECT_NEAR(pose.T_map_base.x_m, 6.8, 0.01);
}

}  // namespace
}  // namespace cornerd::core
