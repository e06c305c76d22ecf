// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::tool {

/// Owner, mode and device numbers of a file.
struct FileFacts {
  uid_t uid = 0;
  gid_t gid = 0;
  mode_t mode = 0;            ///< its kind, and its permissions in the last nine bits
  unsigned device_major = 0;  ///< of its file system
  unsigned device_minor = 0;
  std::uint64_t inode = 0;
  unsigned own_major = 0;  ///< of a device: its number
  unsigned own_minor = 0;
};

/// Read access to /proc, /sys, /dev and /etc below a root, which tests replace. Paths are absolute
/// inside the root.
class Machine {
 public:
  /// `files_are_devices`: regular files below /dev count as devices (for tests without root).
  explicit Machine(std::filesystem::path root = "/", bool files_are_devices = false)
      : root_(std::move(root)), files_are_devices_(files_are_devices) {}

  bool exists(const std::filesystem::path& file) const;
  /// Follows links; nullopt if the file does not exist.
  std::optional<FileFacts> facts(const std::filesystem::path& file) const;
  /// At most 4 MiB; nullopt if the file cannot be read.
  std::optional<std::string> read(const std::filesystem::path& file) const;
  /// The first line; empty where there is none.
  std::string read_line(const std::filesystem::path& file) const;
  /// The target of a link; empty if it is no link or cannot be read.
  std::string read_link(const std::filesystem::path& link) const;
  /// Names in a folder, sorted; empty if it cannot be read.
  std::vector<std::string> list(const std::filesystem::path& folder) const;
  bool may_list(const std::filesystem::path& folder) const;
  /// The path with all links followed.
  std::filesystem::path resolve(const std::filesystem::path& file) const;
  /// Every path that a lookup of the file visits, in order: folders, links, link targets, the file.
  std::vector<std::filesystem::path> steps(const std::filesystem::path& file) const;

 private:
  std::filesystem::path follow(const std::filesystem::path& file,
                               std::vector<std::filesystem::path>* steps) const;
  std::filesystem::path outside(const std::filesystem::path& inside) const;

  std::filesystem::path root_;
  bool files_are_devices_;
};

/// "one two\tthree" at any of the separators; empty words are left out.
std::vector<std::string_view> split_words(std::string_view text, std::string_view separators);

}  // namespace cornerd::tool
