// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/sensor_bias.hpp"
#include "settings/config.hpp"

namespace cornerd::settings {

/// What a daemon learnt of its lidar, as it is kept for the next run.
struct LearnedLidar {
  std::string serial;           ///< of the device; empty where it does not say
  core::SensorBias configured;  ///< lidar.bias of the settings that it was learnt under
  core::EstimatedBias learned;
};

inline constexpr std::size_t kMaxLearnedLidarBytes = 4096;

/// `file` names it in errors. Throws SettingsError.
LearnedLidar parse_learned_lidar(std::string_view text, const std::filesystem::path& file);
std::string text_of(const LearnedLidar& lidar);

}  // namespace cornerd::settings
