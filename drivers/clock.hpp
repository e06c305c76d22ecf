// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <stop_token>

#include "core/types.hpp"

namespace cornerd::drivers {

/// The time as a driver sees it; a test brings its own. Safe for concurrent calls.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Never steps: what intervals are measured with.
  virtual core::TimeNs monotonic_ns() = 0;
  /// UNIX time less monotonic time, now. Steps when somebody sets the clock.
  virtual core::TimeNs unix_offset_ns() = 0;
  /// Returns early when a stop is asked for.
  virtual void wait(std::chrono::milliseconds duration, const std::stop_token& stop) = 0;
};

/// The system's.
Clock& system_clock();

}  // namespace cornerd::drivers
