// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "settings/config.hpp"

namespace cornerd::settings {

/// The file of one of the config's `maps`, of the first for kAutoMap. Throws SettingsError.
std::filesystem::path map_named(const Config& config, const std::string& name);

/// `file` with its symbolic links resolved; a relative one is in the folder of the config's map.
/// Throws SettingsError unless it is below a folder of one of the config's maps: a client must not
/// read the daemon's other files.
std::filesystem::path map_in_folders(const Config& config, const std::filesystem::path& file);

/// Of what is allowed, and hardly meant: two of "maps" that are one file, a lidar metres beside the
/// robot.
std::vector<std::string> warnings_of(const Config& config);

}  // namespace cornerd::settings
