// SPDX-License-Identifier: MIT
// Attributes of sysfs devices: finding a device by name, reading a file of it, parsing its text.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/serial/file_descriptor.hpp"

namespace cornerd::drivers {

std::string_view without_newline(std::string_view text);

/// "1234\n", "-128\n". Nullopt for any other text, and for what int64 does not hold.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// "0.001064724\n", "-3\n", as IIO prints scales. Nullopt for any other text, exponents,
/// infinities and NaN included.
std::optional<double> parse_decimal(std::string_view text);

/// An open attribute; each read() gets a new value from the device.
class Attribute {
 public:
  /// 0, or the errno of open(); the attribute is closed then.
  int open(const std::filesystem::path& file);
  void close() { fd_ = {}; }
  bool is_open() const { return fd_.is_open(); }
  /// False if the path no longer leads to the open file: the device went away, or came back.
  bool is_current() const;

  struct Reading {
    int error = 0;          ///< errno; ENODEV if the device is gone
    std::string_view text;  ///< valid until the next read()
  };
  Reading read();

 private:
  FileDescriptor fd_;
  std::string file_;
  std::array<char, 64> text_{};
};

/// Opens, reads and closes. Nullopt if the attribute does not exist or cannot be read.
std::optional<std::string> read_attribute(const std::filesystem::path& file);

struct FoundDevice {
  std::filesystem::path folder;  ///< empty: not found
  std::string problem;           ///< for a person
};

/// The only device in the folder `devices` whose attribute `name` or `label` is `name`. The numbers
/// in the folders' own names follow the order of loading and identify nothing.
FoundDevice find_device(const std::filesystem::path& devices, std::string_view name);

}  // namespace cornerd::drivers
