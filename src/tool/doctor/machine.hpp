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

/// Whose a file is and where it lies.
struct FileFacts {
  uid_t uid = 0;
  gid_t gid = 0;
  mode_t mode = 0;            ///< its kind, and its permissions in the last nine bits
  unsigned device_major = 0;  ///< of the file system that it lies on
  unsigned device_minor = 0;
  std::uint64_t inode = 0;
  unsigned own_major = 0;  ///< of a device: its number
  unsigned own_minor = 0;
};

/// The files that tell how a machine is: /proc, /sys, /dev, /etc. A test brings a tree of its own;
/// paths are absolute, and as seen from inside it.
class Machine {
 public:
  /// `files_are_devices`: ordinary files below /dev stand for devices, which not everybody can
  /// make.
  explicit Machine(std::filesystem::path root = "/", bool files_are_devices = false)
      : root_(std::move(root)), files_are_devices_(files_are_devices) {}

  bool exists(const std::filesystem::path& file) const;
  /// Of what a link leads to; nullopt where there is nothing.
  std::optional<FileFacts> facts(const std::filesystem::path& file) const;
  /// At most 4 MiB; nullopt where it is not there or must not be read.
  std::optional<std::string> read(const std::filesystem::path& file) const;
  /// The first line; empty where there is none.
  std::string read_line(const std::filesystem::path& file) const;
  /// What a link says; empty where it is none or must not be read.
  std::string read_link(const std::filesystem::path& link) const;
  /// Names of what is in a folder, sorted; empty where it must not be read.
  std::vector<std::string> list(const std::filesystem::path& folder) const;
  bool may_list(const std::filesystem::path& folder) const;
  /// The path with every link on its way followed.
  std::filesystem::path resolve(const std::filesystem::path& file) const;
  /// All that is looked up on the way to a file, in this order: every folder, every link and what
  /// each leads to, and the file.
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
