// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "core/sensor_bias.hpp"
#include "settings/config.hpp"
#include "settings/lidar_calibration.hpp"

namespace cornerd::daemon {

/// Where the settings, or else the service manager, want to have kept what was learnt of the lidar;
/// empty: nowhere. A recording teaches nothing about a device.
std::filesystem::path calibration_file(const settings::LidarConfig& config);

/// What is estimate of the lidar, from one run of the daemon to the next. What cannot be read or
/// written is a line in the log, and costs nothing else. For the server's thread.
class CalibrationFile {
 public:
  /// Recalls what was kept under the same settings. `file`: empty: nothing is kept. JSON
  /// that was not written by a CalibrationFile is left alone, what is none renamed to *.bad.
  /// `configured`: lidar.bias of the settings.
  CalibrationFile(const std::filesystem::path& file, const core::SensorBias& configured);

  /// Of this lidar under these settings; no turns: nothing.
  const core::EstimatedBias& estimate() const { return content_.learned; }

  /// The device has said its number. False where what was estimate is another one's: now nothing
  /// is.
  bool identify(std::string_view serial);

  /// The settings have this lidar.bias now. False where it is another one: now nothing is estimate.
  bool reconfigure(const core::SensorBias& configured);

  /// What the turns have taught by now, of this lidar under these settings. Writes it down where it
  /// says more than what is there already: a dozen times in the first minutes, hardly ever later.
  void update(const core::EstimatedBias& learned);

 private:
  void load();
  bool is_significant() const;

  std::filesystem::path file_;
  settings::LidarCalibration content_;
  core::EstimatedBias written_;
  bool has_warned_ = false;
};

}  // namespace cornerd::daemon
