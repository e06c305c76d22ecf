// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>

namespace cornerd::client {

/// How long a client waits before it connects again: twice as long each time.
class RetryDelay {
 public:
  /// The daemon restarts in less than a second.
  static constexpr std::chrono::milliseconds kFirst{200};

  explicit RetryDelay(std::chrono::milliseconds largest) : largest_(largest) {}

  std::chrono::milliseconds next() {
    const auto delay = next_;
    next_ = std::min(next_ * 2, largest_);
    return delay;
  }
  /// Call at the first message: a daemon that accepts and exits is no success.
  void reset() { next_ = kFirst; }

 private:
  std::chrono::milliseconds largest_;
  std::chrono::milliseconds next_ = kFirst;
};

}  // namespace cornerd::client
