// SPDX-License-Identifier: MIT
#include "calibration/drive_window.hpp"

#include <gtest/gtest.h>

#include "known_drive.hpp"

namespace cornerd::calibration {
namespace {

TEST(CutWindows, WholeDrive_GivesWindowsOfOneSecond) {
  const KnownDrive known = known_drive({}, 1);
  const auto windows = cut_windows(known.steps, known.places);
  ASSERT_EQ(windows.size(), 53U);  // a place each 0.14 s, the eighth is the first after a second
  for (const DriveWindow& window : windows) {
    EXPECT_EQ(window.steps.back().to_ns - window.steps.front().from_ns, 1'120'000'000);
    EXPECT_NEAR(window.distance_m, 0.4 * 1.12, 0.001);
    EXPECT_NEAR(core::angle_between(window.rotation_rad, window.motion.theta_rad), 0, 1e-9);
  }
}

TEST(CutWindows, BackwardDrive_HasNegativeDistance) {
  KnownDrive known = known_drive({}, 0);
  for (KnownPose& place : known.places) {
    place.T_map_base = core::Pose2{-0.4 * core::to_seconds(place.t_ns), 0, 0};
  }
  const auto windows = cut_windows(known.steps, known.places);
  ASSERT_FALSE(windows.empty());
  EXPECT_NEAR(windows.front().distance_m, -0.4 * 1.12, 1e-9);
}

TEST(CutWindows, GapOrMissingPose_LeavesWindowOut) {
  KnownDrive known = known_drive({}, 1);
  const std::size_t whole = cut_windows(known.steps, known.places).size();
  known.steps[70].is_gap = true;
  EXPECT_EQ(cut_windows(known.steps, known.places).size(), whole - 1);
  known.places.erase(known.places.begin() + 100, known.places.begin() + 130);
  EXPECT_EQ(cut_windows(known.steps, known.places).size(), whole - 1 - 4);
  EXPECT_TRUE(cut_windows({}, known.places).empty());
  EXPECT_TRUE(cut_windows(known.steps, {}).empty());
}

}  // namespace
}  // namespace cornerd::calibration
