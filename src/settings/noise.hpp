// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/sensor_noise.hpp"
#include "settings/object_reader.hpp"

namespace cornerd::settings {

/// The object /lidar/noise of a config: floor, share, bearing, ranges. Throws SettingsError.
void read_noise(ObjectReader noise, core::SensorNoise& config);

/// The key /lidar/noise of a config, or of a file that has nothing else. Throws SettingsError, also
/// where the file does not have the key.
core::SensorNoise load_noise(const std::filesystem::path& file);

}  // namespace cornerd::settings
