// SPDX-License-Identifier: MIT
// The service manager's protocols, without libsystemd: sd_listen_fds(3) and sd_notify(3).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// A listening socket that the service manager opened.
struct InheritedSocket {
  std::filesystem::path path;  ///< its address
  FileDescriptor fd;           ///< non-blocking
};

/// Takes the listening UNIX stream sockets passed to this process ($LISTEN_PID, $LISTEN_FDS) and
/// closes other passed descriptors. A second call returns none.
std::vector<InheritedSocket> take_inherited_sockets();

/// Notifies the service manager. Does nothing if $NOTIFY_SOCKET is not set.
class Notifier {
 public:
  /// Reads $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID.
  Notifier();

  void ready() { send("READY=1"); }
  /// A reload has started; ready() ends it.
  void reloading() { send("RELOADING=1"); }
  void stopping() { send("STOPPING=1"); }
  void alive() { send("WATCHDOG=1"); }
  /// One line for `systemctl status`, sent if it differs from the last.
  void status(std::string_view text);

  /// Period for alive(): half of the watchdog's timeout. nullopt if there is no watchdog.
  std::optional<std::uint64_t> watchdog_period_us() const { return watchdog_period_us_; }

 private:
  void send(std::string_view state);

  std::string address_;
  FileDescriptor socket_;
  std::string status_;
  std::optional<std::uint64_t> watchdog_period_us_;
};

}  // namespace cornerd::daemon
