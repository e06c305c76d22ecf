// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::mqtt {

/// The versions of one map of the site that this robot keeps: files MAP.VERSION.json in a folder.
class MapFolder {
 public:
  struct File {
    std::uint64_t version = 0;
    std::string sha256;
    std::filesystem::path path;
  };

  MapFolder(std::filesystem::path folder, std::string map);

  /// The newest first. A file that is no map is not among them.
  const std::vector<File>& files() const { return files_; }

  /// Writes a new version, which must be newer than each other; whole or not at all. Older ones but
  /// the last are removed. Throws std::system_error.
  void add(std::uint64_t version, std::string_view text);
  /// Removes the newest version.
  void drop_newest();

 private:
  std::filesystem::path folder_;
  std::string map_;
  std::vector<File> files_;
};

}  // namespace cornerd::mqtt
