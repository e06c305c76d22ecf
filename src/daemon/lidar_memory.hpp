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

/// What is known of the lidar, from one run of the daemon to the next. What cannot be read or
/// written is a line in the log, and costs nothing else. For the server's thread.
class LidarMemory {
 public:
  /// Recalls what was kept under the same settings. `file`: empty: nothing is kept. JSON
  /// that was not written by a LidarMemory is left alone, what is none renamed to *.bad.
  /// `configured`: advanced.lidar.bias of the settings.
  LidarMemory(const std::filesystem::path& file, const core::SensorBias& configured);

  /// Of this lidar under these settings; no turns: nothing.
  const core::LearnedBias& known() const { return known_.learned; }

  /// The device has said its number. False where what was known is another one's: now nothing is.
  bool recognise(std::string_view serial);

  /// The settings have this advanced.lidar.bias now. False where it is another one, which discards
  /// the estimate.
  bool reconfigure(const core::SensorBias& configured);

  /// What the turns have taught by now, of this lidar under these settings. Writes it down where it
  /// says more than what is there already: a dozen times in the first minutes, hardly ever later.
  void keep(const core::LearnedBias& learned);

 private:
  void recall();
  bool is_news() const;

  std::filesystem::path file_;
  settings::LidarCalibration known_;
  core::LearnedBias written_;
  bool complained_ = false;
};

}  // namespace cornerd::daemon
