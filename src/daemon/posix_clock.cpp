// SPDX-License-Identifier: MIT
#include "daemon/posix_clock.hpp"

#include <cstdlib>

namespace cornerd::daemon {
namespace {

/// adjtimex(2) slews by at most 10 %: 10 ms in the 0.1 s between two calls.
constexpr std::int64_t kStepNs = 50'000'000;

}  // namespace

std::optional<std::int64_t> ClockStepDetector::step_ns(std::int64_t unix_ns,
                                                       std::int64_t monotonic_ns) {
  const std::int64_t offset_ns = unix_ns - monotonic_ns;
  const std::int64_t moved_ns = offset_ns - offset_ns_.value_or(offset_ns);
  offset_ns_ = offset_ns;
  return std::abs(moved_ns) >= kStepNs ? std::optional(moved_ns) : std::nullopt;
}

}  // namespace cornerd::daemon
