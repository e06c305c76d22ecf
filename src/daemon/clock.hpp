// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <ctime>

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

}  // namespace cornerd::daemon
