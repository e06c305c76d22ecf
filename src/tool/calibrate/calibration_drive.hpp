// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "calibration/drive_window.hpp"
#include "core/odometry/odometry_increment.hpp"
#include "core/odometry/reading_gate.hpp"
#include "drivers/make_driver.hpp"
#include "settings/config.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

/// A drive's odometry and poses.
struct CalibrationDrive {
  std::vector<core::OdometryIncrement> steps;
  std::vector<core::OdometryIncrement>
      increments_within_wide_limits;  ///< with 100 times wider limits
  core::OdometryCounters counters;    ///< of `steps`
  std::vector<calibration::KnownPose> places;
  std::vector<core::OdometryReading> readings;  ///< all of them, as they came
};

/// Poses come from `truth`, or from the lidar's fixes if it is null. `deskewed`: by wheels and
/// gyro. Throws replay::RecordingError and settings::SettingsError.
CalibrationDrive play_drive(const std::filesystem::path& file, drivers::RecordedWire wire,
                            const settings::Config& config, const Truth* truth, bool deskewed);

/// The lidar's fixes with scans deskewed by the readings `delay_s` earlier. Throws as play_drive().
std::vector<calibration::KnownPose> localize_drive(const std::filesystem::path& file,
                                                   drivers::RecordedWire wire,
                                                   const settings::Config& config,
                                                   std::vector<core::OdometryReading> readings,
                                                   double delay_s);

}  // namespace cornerd::tool
