// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "daemon/require_fd.hpp"

namespace cornerd::system_test {

/// A service manager's end of $NOTIFY_SOCKET.
class ServiceManager {
 public:
  explicit ServiceManager(const std::filesystem::path& socket);

  /// True once that word has come; others before it are passed over.
  bool hears(const std::string& word) const;
  /// Passes over what has come so far.
  void forget() const;

 private:
  daemon::FileDescriptor fd_;
};

}  // namespace cornerd::system_test
