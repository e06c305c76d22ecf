// SPDX-License-Identifier: MIT
#include "tool/map/drive_points.hpp"

#include <gtest/gtest.h>

namespace cornerd::tool {
namespace {

constexpr core::TimeNs kScanNs = core::kNsPerSecond / 5;

/// Three samples ahead, at its beginning, middle and end; the second without a return.
core::Scan scan_at(core::TimeNs start_ns) {
  core::Scan scan;
  for (int i = 0; i < 3; ++i) {
    core::Sample sample;
    sample.t_ns = start_ns + i * kScanNs / 2;
    sample.range_m = i == 1 ? 0.0F : 2.0F;
    scan.add(sample);
  }
  return scan;
}

TEST(DrivePoints, ReturnBetweenTwoScans_UsesInterpolatedPose) {
  DrivePoints drive;
  drive.add(scan_at(0), core::Pose2{0, 0, 0});
  drive.add(scan_at(kScanNs), core::Pose2{1, 0, 0});
  const auto points = drive.place({0.5, 0, 0});
  ASSERT_EQ(points.size(), 4U);
  EXPECT_NEAR(points[0].x(), 2.5, 1e-9);  // nothing is known of before
  EXPECT_NEAR(points[1].x(), 3.0, 1e-9);
  EXPECT_NEAR(points[2].x(), 3.0, 1e-9);
  EXPECT_NEAR(points[3].x(), 3.5, 1e-9);
}

TEST(DrivePoints, ScanLongAgoOrLost_IsNotInterpolated) {
  DrivePoints drive;
  drive.add(scan_at(0), core::Pose2{0, 0, 0});
  drive.add(scan_at(10 * kScanNs), core::Pose2{1, 0, 0});
  drive.add(scan_at(11 * kScanNs), std::nullopt);
  const auto points = drive.place({});
  ASSERT_EQ(points.size(), 4U);
  EXPECT_NEAR(points[1].x(), 2, 1e-9);
  EXPECT_NEAR(points[2].x(), 3, 1e-9);
  EXPECT_NEAR(points[3].x(), 3, 1e-9);
}

TEST(DrivePoints, Trajectory_PlacesReturns) {
  DrivePoints drive;
  drive.add(scan_at(0), std::nullopt);
  message::RecordedTruth begin;
  begin.t_ns = kScanNs / 2;
  message::RecordedTruth end;
  end.t_ns = kScanNs;
  end.T_map_base = {0, 1, 0};
  const auto points = drive.place({}, Truth({begin, end}));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR((points[0] - core::Vec2(2, 1)).norm(), 0, 1e-9);
}

TEST(ThinOut, PointsInOneSquare_OneRemainsAndNoneBeyond) {
  const auto kept =
      thin_out({{0.1, 0.1}, {0.2, 0.2}, {1.5, 0.1}, {-1, 0}, {9, 9}}, 1, {0, 0}, {3, 3});
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0], core::Vec2(0.1, 0.1));
  EXPECT_EQ(kept[1], core::Vec2(1.5, 0.1));
}

}  // namespace
}  // namespace cornerd::tool
