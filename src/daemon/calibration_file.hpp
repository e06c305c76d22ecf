// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/sensor_bias.hpp"
#include "settings/config.hpp"
#include "settings/lidar_calibration.hpp"

namespace cornerd::daemon {

/// Path of the lidar's calibration file: the configured one, or lidar.json in $STATE_DIRECTORY.
/// Empty (no file) without either, and for a recording.
std::filesystem::path calibration_file_path(const settings::LidarConfig& config);

/// Keeps the estimated bias of the lidar across restarts. Errors are logged and otherwise ignored.
/// For the server thread.
class CalibrationFile {
 public:
  /// Loads `file`; if its name is empty, nothing is stored. A JSON file of another format is left
  /// alone; a file that is not JSON is renamed to *.bad. A stored bias is used only if it was
  /// estimated with the same `configured` bias (/advanced/lidar/bias).
  CalibrationFile(const std::filesystem::path& file, const core::SensorBias& configured);

  /// The stored or newest estimate; 0 scans if there is none.
  const core::EstimatedBias& estimate() const { return content_.learned; }

  /// Sets the device's serial number. Returns false, and forgets the estimate, if the number
  /// differs from the stored one.
  bool identify(std::string_view serial);

  /// Sets the configured bias. Returns false, and forgets the estimate, if it differs.
  bool reconfigure(const core::SensorBias& configured);

  /// Takes a newer estimate and writes it if it differs significantly from the stored one: about a
  /// dozen times in the first minutes, rarely later.
  void update(const core::EstimatedBias& learned);

  /// Why the estimate is not kept; empty if nothing is wrong.
  const std::string& problem() const { return problem_; }

 private:
  void load();
  bool is_significant() const;

  std::filesystem::path file_;
  settings::LidarCalibration content_;
  core::EstimatedBias written_;
  std::string problem_;
};

}  // namespace cornerd::daemon
