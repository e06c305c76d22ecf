// SPDX-License-Identifier: MIT
#pragma once

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// From here on SIGHUP waits for a Signals to take it, and ends nothing.
void hold_reloads();

/// SIGTERM, SIGINT and SIGHUP as something to wait for. From its construction on none of them ends
/// the program. Make it before any thread, since threads inherit that the signals are blocked.
class Signals {
 public:
  /// Throws std::system_error.
  Signals();

  int fd() const { return fd_.get(); }
  /// The number of the signal that came; 0 where none did.
  int take() const;

 private:
  FileDescriptor fd_;
};

}  // namespace cornerd::daemon
