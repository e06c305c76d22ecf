// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// A descriptor that becomes readable once a period.
class PeriodicTimer {
 public:
  /// Throws std::system_error.
  explicit PeriodicTimer(std::chrono::nanoseconds period);

  int fd() const { return fd_.get(); }
  /// No longer readable until the next period. Returns by how much this one is late.
  std::chrono::nanoseconds acknowledge();

 private:
  std::chrono::nanoseconds period_;
  FileDescriptor fd_;
  std::chrono::nanoseconds due_;  ///< on the monotonic clock
};

}  // namespace cornerd::daemon
