// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "settings/config.hpp"
#include "settings/object_reader.hpp"

namespace cornerd::settings {

/// The object /lidar/noise of a config: floor, share, bearing, ranges, wall. Throws SettingsError.
void read_noise(ObjectReader noise, NoiseConfig& config);

/// The key /lidar/noise of a config, or of a file that has nothing else. Throws SettingsError, also
/// where the file does not have the key.
NoiseConfig load_noise(const std::filesystem::path& file);

}  // namespace cornerd::settings
