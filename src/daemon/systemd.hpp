// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// A variable as a decimal number; nullopt where it is not set, or is anything else.
std::optional<std::uint64_t> number_in_environment(const char* name);

/// A socket that listens already: the service manager's, see sd_listen_fds(3).
struct InheritedSocket {
  std::filesystem::path path;  ///< that it is bound to
  FileDescriptor fd;           ///< non-blocking
};

/// Those that were passed to this process ($LISTEN_PID, $LISTEN_FDS), as far as they are UNIX
/// stream sockets that listen; others are closed. Takes them over: a second call finds none.
std::vector<InheritedSocket> take_inherited_sockets();

/// Tells the service manager how things stand: sd_notify(3) without its library. Silent where
/// nobody asked ($NOTIFY_SOCKET is not set).
class Notifier {
 public:
  /// Reads $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID.
  Notifier();

  void ready() { send("READY=1"); }
  /// Settings are being read again; ready() says that this is over.
  void reloading() { send("RELOADING=1"); }
  void stopping() { send("STOPPING=1"); }
  void alive() { send("WATCHDOG=1"); }
  /// A line for a person, sent where it differs from the last.
  void status(std::string_view text);

  /// How often to say alive(): half of what the manager waits for, in microseconds, since whole
  /// seconds would make none of a short one. nullopt: the manager does not watch us.
  std::optional<std::uint64_t> watchdog_period_us() const { return watchdog_period_us_; }

 private:
  void send(std::string_view state);

  std::string address_;
  FileDescriptor socket_;
  std::string status_;
  std::optional<std::uint64_t> watchdog_period_us_;
};

}  // namespace cornerd::daemon
