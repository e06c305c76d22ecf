// SPDX-License-Identifier: MIT
#include "survey/recorded_drive.hpp"

#include <gtest/gtest.h>

namespace cornerd::survey {
namespace {

core::Scan scan_at(core::TimeNs start_ns, float range_m) {
  core::Scan scan;
  for (int i = 0; i < 4; ++i) {
    core::Sample sample;
    sample.t_ns = start_ns + i * 1'000'000;
    sample.bearing_rad = static_cast<float>(i);
    sample.range_m = range_m;
    scan.add(sample);
  }
  return scan;
}

TEST(RecordedDrive, Load_AfterAdd_ReturnsTheSamples) {
  RecordedDrive drive;
  drive.add(scan_at(5'000'000'000, 1));
  drive.add(scan_at(6'000'000'000, 2));
  core::Scan scan;
  drive.load(1, scan);
  ASSERT_EQ(scan.size(), 4U);
  EXPECT_EQ(scan.samples()[3].t_ns, 6'003'000'000);
  EXPECT_FLOAT_EQ(scan.samples()[3].bearing_rad, 3);
  EXPECT_FLOAT_EQ(scan.samples()[3].range_m, 2);
  EXPECT_EQ(drive.middle_ns(1), 6'001'500'000);
}

TEST(RecordedDrive, Add_Reading_StoresCurrentScan) {
  RecordedDrive drive;
  drive.add(scan_at(0, 1));
  drive.add(core::OdometryReading{});
  EXPECT_EQ(drive.readings().front().scan, 1U);
}

TEST(RecordedDrive, SetOdometry_OtherFile_AssignsScansByTime) {
  RecordedDrive drive;
  drive.add(scan_at(0, 1));
  drive.add(scan_at(100'000'000, 1));
  drive.set_odometry({{.t_ns = 1'000'000, .left = {}, .right = {}, .gyro_rad_s = {}},
                      {.t_ns = 100'500'000, .left = {}, .right = {}, .gyro_rad_s = {}}});
  ASSERT_EQ(drive.readings().size(), 2U);
  EXPECT_EQ(drive.readings()[0].scan, 0U);
  EXPECT_EQ(drive.readings()[1].scan, 1U);
}

TEST(RecordedDrive, EndNs_EmptyScan_IsItsStart) {
  RecordedDrive drive;
  drive.add(core::Scan());
  EXPECT_EQ(drive.end_ns(0), drive.start_ns(0));
}

}  // namespace
}  // namespace cornerd::survey
