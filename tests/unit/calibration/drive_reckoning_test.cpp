// SPDX-License-Identifier: MIT
#include "calibration/drive_reckoning.hpp"

#include <gtest/gtest.h>

namespace cornerd::calibration {
namespace {

constexpr core::TimeNs kStep_ns = 20'000'000;
constexpr double kLeftScale = 0.015;
constexpr double kRightScale = 0.025;

/// A minute of straights and rotations with poses every 0.14 s and scale errors of the wheels.
class FilteredDriveTest : public ::testing::Test {
 protected:
  FilteredDriveTest() {
    core::Pose2 T_map_base{1, 2, 0.5};
    for (int i = 0; i < 3000; ++i) {
      if (i % 7 == 0) places_.push_back({i * kStep_ns, T_map_base});
      const int part = i / 100 % 3;
      const double rotation_rad = (part == 0 ? 0.0 : part == 1 ? 0.9 : -0.7) * 0.02;
      const double way_m = 0.4 * 0.02;
      T_map_base = T_map_base * core::arc(way_m, rotation_rad);
      const double half_m = rotation_rad * config_.geometry.track_m / 2;
      core::OdometryIncrement step;
      step.from_ns = i * kStep_ns;
      step.to_ns = step.from_ns + kStep_ns;
      step.left_m = (way_m - half_m) / (1 + kLeftScale);
      step.right_m = (way_m + half_m) / (1 + kRightScale);
      steps_.push_back(step);
    }
  }
  FilteredDrive filter(double taught_s) const {
    return filter_drive(steps_, places_, config_, core::from_seconds(taught_s));
  }

  core::OdometryConfig config_;
  std::vector<core::OdometryIncrement> steps_;
  std::vector<KnownPose> places_;
};

TEST_F(FilteredDriveTest, CorrectedFirstHalf_ImprovesSecondHalf) {
  const FilteredDrive drive = filter(30);
  EXPECT_NEAR(drive.learned.left_scale, kLeftScale, 0.003);
  EXPECT_NEAR(drive.learned.right_scale, kRightScale, 0.003);
  EXPECT_EQ(drive.points.size(), places_.size() - 1);
  EXPECT_NEAR(static_cast<double>(drive.alone.places), 30 / 0.14, 2);
  const DriveError raw =
      reckon(steps_, places_, config_.geometry, calibration::DeadReckoningConfig{});
  EXPECT_LT(drive.alone.end_m, raw.end_m / 5);
}

TEST_F(FilteredDriveTest, WithoutCorrections_IsDeadReckoning) {
  const FilteredDrive drive = filter(0);
  const DriveError raw =
      reckon(steps_, places_, config_.geometry, calibration::DeadReckoningConfig{});
  EXPECT_NEAR(drive.alone.end_m, raw.end_m, 1e-6);
  EXPECT_EQ(drive.alone.places, raw.places);
}

TEST_F(FilteredDriveTest, NoKnownPoses_GiveNoErrors) {
  const FilteredDrive drive = filter_drive(steps_, {}, config_, 0);
  EXPECT_TRUE(drive.points.empty());
  EXPECT_EQ(drive.alone.places, 0u);
}

}  // namespace
}  // namespace cornerd::calibration
