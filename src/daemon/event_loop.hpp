// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// Calls whoever waits for a descriptor: epoll, level-triggered. One thread.
class EventLoop {
 public:
  /// `events`: those of epoll(7). A handler may add and remove any descriptor, its own too.
  using Handler = std::function<void(std::uint32_t events)>;

  /// Throws std::system_error, as does add().
  EventLoop();

  /// The descriptor stays its owner's, who removes it before closing it.
  void add(int fd, std::uint32_t events, Handler handler);
  void change(int fd, std::uint32_t events);
  void remove(int fd);

  /// One round: waits for events at most `timeout_ms` (-1: for ever), and handles them.
  void run_once(int timeout_ms);
  /// Rounds until stop().
  void run();
  void stop() { running_ = false; }

 private:
  struct Registration {
    std::uint32_t number = 0;
    std::shared_ptr<const Handler> handler;
  };

  FileDescriptor epoll_;
  std::unordered_map<int, Registration> registrations_;
  std::uint32_t newest_ = 0;
  bool running_ = false;
};

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

/// From here on SIGHUP waits for a Signals to take it, and ends nothing.
void block_reloads();

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
