// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/serial/file_descriptor.hpp"

namespace cornerd::drivers {

/// An attribute of a device in sysfs, kept open: every read() asks the device anew.
class Attribute {
 public:
  /// 0, or the errno of a refusal; it is closed then.
  int open(const std::filesystem::path& file);
  void close() { fd_ = {}; }
  bool is_open() const { return fd_.is_open(); }
  /// False where the name leads to another file by now, or to none: the device went and came back.
  bool is_current() const;

  struct Reading {
    int error = 0;          ///< errno; ENODEV where the device is gone
    std::string_view text;  ///< valid until the next read()
  };
  Reading read();

 private:
  FileDescriptor fd_;
  std::string file_;
  std::array<char, 64> text_{};
};

/// Opens, reads and closes. Nullopt where there is no such attribute, or none that can be read.
std::optional<std::string> read_attribute(const std::filesystem::path& file);

}  // namespace cornerd::drivers
