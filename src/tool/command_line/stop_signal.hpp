// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <csignal>

namespace cornerd::tool {

/// SIGINT and SIGTERM as something to wait for. Made before the threads that must not be
/// interrupted by them.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// True where one of them came within the time.
  bool wait(std::chrono::nanoseconds timeout) const;

 private:
  sigset_t signals_{};
  sigset_t before_{};
};

}  // namespace cornerd::tool
