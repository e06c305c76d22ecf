// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <stop_token>

#include "core/types.hpp"

namespace cornerd::drivers {

/// The drivers' clock; tests replace it. Safe for concurrent calls.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Never steps: for intervals.
  virtual core::TimeNs monotonic_ns() = 0;
  /// UNIX time minus monotonic time. Steps when the system clock is set.
  virtual core::TimeNs unix_offset_ns() = 0;
  /// Returns early if a stop is requested.
  virtual void wait(std::chrono::milliseconds duration, const std::stop_token& stop) = 0;
};

Clock& system_clock();

}  // namespace cornerd::drivers
