// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/sensor_bias.hpp"

namespace cornerd::settings {

/// The lidar's bias as the daemon estimated it, kept in a file for the next run.
struct LidarCalibration {
  std::string serial;           ///< of the device; empty where it has none
  core::SensorBias configured;  ///< /advanced/lidar/bias at the time of the estimate
  core::EstimatedBias learned;
};

inline constexpr std::size_t kMaxLidarCalibrationBytes = 4096;

/// `file` names it in errors. Throws SettingsError.
LidarCalibration parse_lidar_calibration(std::string_view text, const std::filesystem::path& file);
std::string text_of(const LidarCalibration& calibration);

nlohmann::ordered_json json_of(const core::SensorBias& bias);

}  // namespace cornerd::settings
