// SPDX-License-Identifier: MIT
#include "settings/map_choice.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

namespace cornerd::settings {
namespace {

namespace fs = std::filesystem;

/// Both are canonical.
bool is_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

std::vector<fs::path> folders_of(const Config& config) {
  std::vector<fs::path> folders;
  const auto add = [&folders](const fs::path& map) {
    std::error_code error;
    const fs::path folder = fs::canonical(map.parent_path(), error);
    if (!error) folders.push_back(folder);
  };
  add(config.map);
  for (const NamedMap& map : config.maps) add(map.file);
  return folders;
}

}  // namespace

fs::path map_named(const Config& config, const std::string& name) {
  if (const fs::path* file = file_of(config.maps, name)) return *file;
  throw SettingsError("SET_MAP", "/name",
                      config.maps.empty() ? "the config has no \"maps\": use \"file\""
                                          : "no map of the config has this name; they are: auto, " +
                                                names_of(config.maps));
}

std::string equal_maps_warning(const Config& config) {
  for (std::size_t i = 0; i < config.maps.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      std::error_code unread;
      if (!fs::equivalent(config.maps[k].file, config.maps[i].file, unread) || unread) continue;
      return "/maps: \"" + config.maps[k].name + "\" and \"" + config.maps[i].name +
             "\" are one file, " + config.maps[i].file.string() +
             ": scans cannot tell them apart; is one of the files wrong?";
    }
  }
  return {};
}

fs::path map_in_folders(const Config& config, const fs::path& file) {
  const auto fail = [](const std::string& reason) {
    throw SettingsError("SET_MAP", "/file", reason);
  };
  std::error_code error;
  const fs::path found = fs::weakly_canonical(config.map.parent_path() / file, error);
  if (error) fail("cannot be found: " + error.message());
  const std::vector<fs::path> folders = folders_of(config);
  if (std::none_of(folders.begin(), folders.end(),
                   [&](const fs::path& folder) { return is_below(found, folder); })) {
    fail("must be below " + config.map.parent_path().string() +
         " or the folder of another map of the config");
  }
  return found;
}

}  // namespace cornerd::settings
