// SPDX-License-Identifier: MIT
#pragma once

#include "daemon/file_descriptor.hpp"

namespace cornerd::daemon {

/// SIGTERM, SIGINT and SIGHUP as a descriptor: the motor is switched off whichever way a person
/// ends the program. Make it before any thread, since threads inherit that the signals are blocked.
class TerminationSignals {
 public:
  /// Throws std::system_error.
  TerminationSignals();

  int fd() const { return fd_.get(); }
  /// The name of the signal that came.
  const char* take() const;

 private:
  FileDescriptor fd_;
};

}  // namespace cornerd::daemon
