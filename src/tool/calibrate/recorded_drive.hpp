// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "calibration/drive_window.hpp"
#include "core/odometry/odometry_increment.hpp"
#include "core/odometry/reading_gate.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "settings/config.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

/// A drive by wheels and gyro, and where the robot was meanwhile.
struct RecordedDrive {
  std::vector<core::OdometryIncrement> steps;
  std::vector<core::OdometryIncrement>
      increments_within_wide_limits;  ///< with whatever wheels and gyro say believed
  core::OdometryCounters counters;    ///< of `steps`
  std::vector<calibration::KnownPose> places;
  std::vector<core::OdometryReading> readings;  ///< all of them, as they came
};

/// Places are the truth's, or the lidar's fixes where it is null. `deskewed`: scans by what
/// wheels and gyro say, which gives better fixes where they are right. Throws
/// replay::RecordingError and settings::SettingsError.
RecordedDrive play_drive(const std::filesystem::path& file, std::optional<rplidar::WireFormat> wire,
                         const settings::Config& config, const Truth* truth, bool deskewed);

/// The lidar's fixes once more, its scans deskewed by readings whose times are earlier by
/// `delay_s` than they say. Throws as play_drive().
std::vector<calibration::KnownPose> localize_drive(const std::filesystem::path& file,
                                                   std::optional<rplidar::WireFormat> wire,
                                                   const settings::Config& config,
                                                   std::vector<core::OdometryReading> readings,
                                                   double delay_s);

}  // namespace cornerd::tool
