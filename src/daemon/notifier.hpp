// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

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
