// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "settings/config.hpp"

namespace cornerd::settings {

/// The file of one of the config's `maps`, of the first for kAutoMap. Throws SettingsError.
std::filesystem::path map_named(const Config& config, const std::string& name);

/// `file` with its symbolic links resolved; a relative one is in the folder of the config's map.
/// Throws SettingsError unless it is below a folder of one of the config's maps: a client must not
/// read the daemon's other files.
std::filesystem::path map_in_folders(const Config& config, const std::filesystem::path& file);

/// A line about two of "maps" that are the same file; empty if there are none.
std::string equal_maps_warning(const Config& config);

}  // namespace cornerd::settings
