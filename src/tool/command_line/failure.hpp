// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "settings/config.hpp"

namespace cornerd::tool {

/// Exit codes of cornerctl.
enum ExitCode : int {
  kExitDone = 0,
  kExitFailed = 1,  ///< reported on standard error
  kExitUsage = 2,
  kExitConfig = settings::kExitConfig  ///< wrong config or map
};

/// Ends a command with kExitFailed. what() is one line for the user.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ends a command with kExitUsage: its options are well formed but contradict each other.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The reader of standard output closed it. Not an error.
class OutputClosed : public std::exception {};

}  // namespace cornerd::tool
