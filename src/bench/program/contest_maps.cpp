// SPDX-License-Identifier: MIT
#include "bench/program/contest_maps.hpp"

#include <string>
#include <system_error>

#include "settings/map_file.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::bench {

namespace {

namespace fs = std::filesystem;

fs::path file_of(const fs::path& folder, char layout) {
  return folder / (std::string("krpai-2019-") + layout + ".json");
}

/// config/maps of the working directory, the installed folder, or config/maps of the source tree.
fs::path find_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  std::vector<fs::path> folders;
  for (fs::path above = program.parent_path(); above.has_relative_path();
       above = above.parent_path()) {
    folders.push_back(above / "config/maps");
  }
  folders.insert(folders.begin(), program.parent_path().parent_path() / "share/cornerd/maps");
  folders.insert(folders.begin(), "config/maps");
  for (const fs::path& folder : folders) {
    if (fs::exists(file_of(folder, 'a'), error)) return folder;
  }
  throw tool::UsageError(
      "krpai-2019-a.json is in no folder of maps (config/maps, share/cornerd/maps); name "
      "the folder: --maps DIR");
}

}  // namespace

fs::path contest_maps_folder(const fs::path& named) {
  return named.empty() ? find_folder() : named;
}

std::vector<std::shared_ptr<const core::WallMap>> load_contest_maps(const fs::path& folder) {
  const fs::path found = contest_maps_folder(folder);
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  for (const char layout : {'a', 'b', 'c', 'd'}) {
    maps.push_back(settings::load_map(file_of(found, layout)));
  }
  return maps;
}

}  // namespace cornerd::bench
