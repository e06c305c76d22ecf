// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>

#include "daemon/require_fd.hpp"

namespace cornerd::daemon {

/// Dispatches events of file descriptors: epoll, level-triggered, one thread.
class EventLoop {
 public:
  /// `events`: see epoll_ctl(2). A handler may add and remove any descriptor, including its own.
  using Handler = std::function<void(std::uint32_t events)>;

  /// Throws std::system_error, like add().
  EventLoop();

  /// Does not take ownership of `fd`. Call remove() before closing it.
  void add(int fd, std::uint32_t events, Handler handler);
  /// No system call if they are the same.
  void change(int fd, std::uint32_t events);
  void remove(int fd);

  /// Waits at most `timeout_ms` for events (-1: no limit) and handles them.
  void run_once(int timeout_ms);
  /// Handles events until stop().
  void run();
  void stop() { running_ = false; }

 private:
  struct Registration {
    std::uint32_t number = 0;
    std::uint32_t events = 0;
    std::shared_ptr<const Handler> handler;
  };

  FileDescriptor epoll_;
  std::unordered_map<int, Registration> registrations_;
  std::uint32_t newest_ = 0;
  bool running_ = false;
};

/// A file descriptor that becomes readable once per period.
class PeriodicTimer {
 public:
  /// Throws std::system_error.
  explicit PeriodicTimer(std::chrono::nanoseconds period);

  int fd() const { return fd_.get(); }
  /// Makes the descriptor unreadable until the next period. Returns the delay of this call.
  std::chrono::nanoseconds acknowledge();

 private:
  std::chrono::nanoseconds period_;
  FileDescriptor fd_;
  std::chrono::nanoseconds due_;  ///< on the monotonic clock
};

/// Blocks SIGHUP until a Signals takes it, so that an early reload request does not end the
/// program.
void block_reloads();

/// SIGTERM, SIGINT and SIGHUP as a file descriptor. Construct it before any thread: threads inherit
/// the signal mask.
class Signals {
 public:
  /// Throws std::system_error.
  Signals();

  int fd() const { return fd_.get(); }
  /// The number of the next pending signal; 0 if there is none.
  int take() const;

 private:
  FileDescriptor fd_;
};

}  // namespace cornerd::daemon
