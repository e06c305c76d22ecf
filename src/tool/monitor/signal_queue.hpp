// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <initializer_list>

namespace cornerd::tool {

/// Signals to poll for and to read (signalfd), for one thread.
class SignalQueue {
 public:
  /// Throws Failure.
  explicit SignalQueue(std::initializer_list<int> signals);
  ~SignalQueue();
  SignalQueue(const SignalQueue&) = delete;
  SignalQueue& operator=(const SignalQueue&) = delete;

  int fd() const { return fd_; }
  /// The next one; 0 where there is none.
  int take() const;

 private:
  int fd_ = -1;
  sigset_t before_{};
};

}  // namespace cornerd::tool
