// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace cornerd::daemon {

/// Notices that somebody set the time of day: samples bear UNIX time, and a board without a battery
/// begins with a wrong one.
class ClockWatch {
 public:
  /// How far UNIX time has moved against the monotonic clock since the last call, where that is a
  /// step and not the slewing of a time daemon.
  std::optional<std::int64_t> step_ns(std::int64_t unix_ns, std::int64_t monotonic_ns);

 private:
  std::optional<std::int64_t> offset_ns_;
};

}  // namespace cornerd::daemon
