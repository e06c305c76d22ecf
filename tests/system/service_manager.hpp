// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "daemon/require_fd.hpp"

namespace cornerd::system_test {

/// The service manager's side of $NOTIFY_SOCKET.
class ServiceManager {
 public:
  explicit ServiceManager(const std::filesystem::path& socket);

  /// Waits for this message and skips others; false after a timeout.
  bool hears(const std::string& word) const;
  /// Discards received messages.
  void forget() const;

 private:
  daemon::FileDescriptor fd_;
};

}  // namespace cornerd::system_test
