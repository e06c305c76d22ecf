// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <ctime>
#include <optional>

#include "core/types.hpp"

namespace cornerd::daemon {

/// Nanoseconds of a POSIX clock.
inline std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return std::int64_t{now.tv_sec} * core::kNsPerSecond + now.tv_nsec;
}

inline std::int64_t monotonic_ns() { return clock_ns(CLOCK_MONOTONIC); }
inline core::TimeNs unix_ns() { return clock_ns(CLOCK_REALTIME); }

/// Detects steps of UNIX time. Boards without a battery-backed clock start with a wrong time.
class ClockStepDetector {
 public:
  /// The change of UNIX time relative to the monotonic clock since the last call; nullopt if it is
  /// small enough for the slewing of a time daemon.
  std::optional<std::int64_t> step_ns(std::int64_t unix_ns, std::int64_t monotonic_ns);

 private:
  std::optional<std::int64_t> offset_ns_;
};

}  // namespace cornerd::daemon
