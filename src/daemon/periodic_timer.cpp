// SPDX-License-Identifier: MIT
#include "daemon/periodic_timer.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <cstdint>

#include "core/types.hpp"

namespace cornerd::daemon {

PeriodicTimer::PeriodicTimer(std::chrono::nanoseconds period)
    : fd_(require_fd(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC),
                     "timerfd_create")) {
  itimerspec times{};
  times.it_interval.tv_sec = static_cast<time_t>(period.count() / core::kNsPerSecond);
  times.it_interval.tv_nsec = static_cast<long>(period.count() % core::kNsPerSecond);
  times.it_value = times.it_interval;
  ::timerfd_settime(fd_.get(), 0, &times, nullptr);
}

void PeriodicTimer::acknowledge() const {
  std::uint64_t expirations = 0;
  static_cast<void>(::read(fd_.get(), &expirations, sizeof(expirations)));
}

}  // namespace cornerd::daemon
