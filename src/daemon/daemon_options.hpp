// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cornerd::daemon {

/// Wrong usage of the command line; what() gives the reason.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Options {
  std::filesystem::path config;
  std::vector<std::string> overrides;  ///< "/json/pointer=value"
  bool check = false;
  bool help = false;
  bool version = false;
};

extern const std::string_view kHelp;

/// `arguments`: without the program name. Throws UsageError.
Options parse_options(std::span<const char* const> arguments);

}  // namespace cornerd::daemon
