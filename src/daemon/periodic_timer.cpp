// SPDX-License-Identifier: MIT
#include "daemon/periodic_timer.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <cstdint>

#include "core/types.hpp"
#include "daemon/clock.hpp"

namespace cornerd::daemon {

PeriodicTimer::PeriodicTimer(std::chrono::nanoseconds period)
    : period_(period),
      fd_(require_fd(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC),
                     "timerfd_create")),
      due_(monotonic_ns()) {
  const auto as_timespec = [](std::chrono::nanoseconds duration) {
    return timespec{static_cast<time_t>(duration.count() / core::kNsPerSecond),
                    static_cast<long>(duration.count() % core::kNsPerSecond)};
  };
  const itimerspec times{as_timespec(period), as_timespec(due_ + period)};
  ::timerfd_settime(fd_.get(), TFD_TIMER_ABSTIME, &times, nullptr);
}

std::chrono::nanoseconds PeriodicTimer::acknowledge() {
  std::uint64_t expirations = 0;
  if (::read(fd_.get(), &expirations, sizeof(expirations)) != sizeof(expirations)) return {};
  due_ += static_cast<std::int64_t>(expirations) * period_;
  return std::chrono::nanoseconds(monotonic_ns()) - due_;
}

}  // namespace cornerd::daemon
