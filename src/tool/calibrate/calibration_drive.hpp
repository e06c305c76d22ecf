// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/drive_window.hpp"
#include "core/odometry/odometry_increment.hpp"
#include "core/odometry/reading_gate.hpp"
#include "drivers/make_driver.hpp"
#include "settings/config.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

/// A drive's odometry and poses.
struct CalibrationDrive {
  std::vector<core::OdometryIncrement> steps;
  std::vector<core::OdometryIncrement> increments_within_wide_limits;  ///< with_wide_limits()
  core::OdometryCounters counters;                                     ///< of `steps`
  std::vector<calibration::KnownPose> places;
  std::vector<core::OdometryReading> readings;  ///< all of them, as they came
};

/// A recorded drive.
struct DriveFile {
  std::filesystem::path file;
  drivers::RecordedWire wire{};
  std::filesystem::path odometry;  ///< ODOMETRY lines in place of the recording's own, or empty
};

/// Options of the calibrations by a drive.
struct DriveOptions : CalibrationOptions {
  std::filesystem::path file;
  std::filesystem::path odometry;

  /// The file and --odometry, and CalibrationOptions. `what`: the drive has to be.
  void add_drive(Command& command, const std::string& what, const std::string& key);
  DriveFile drive() const { return {file, parse_wire(wire), odometry}; }
};

/// Poses come from `truth`, or from the lidar's fixes if it is null. `deskewed`: by wheels and
/// gyro. Throws replay::RecordingError, settings::SettingsError and Failure.
CalibrationDrive play_drive(const DriveFile& file, const settings::Config& config,
                            const Truth* truth, bool deskewed);

/// The lidar's fixes with scans deskewed by the readings `delay_s` earlier. Throws as play_drive().
std::vector<calibration::KnownPose> localize_drive(const DriveFile& file,
                                                   const settings::Config& config,
                                                   std::vector<core::OdometryReading> readings,
                                                   double delay_s);

}  // namespace cornerd::tool
