// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "daemon/file_descriptor.hpp"

namespace cornerd::daemon {

/// A descriptor that becomes readable once a period.
class PeriodicTimer {
 public:
  /// Throws std::system_error.
  explicit PeriodicTimer(std::chrono::nanoseconds period);

  int fd() const { return fd_.get(); }
  /// No longer readable until the next period.
  void acknowledge() const;

 private:
  FileDescriptor fd_;
};

}  // namespace cornerd::daemon
