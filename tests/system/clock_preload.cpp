// SPDX-License-Identifier: MIT
// LD_PRELOAD library: offsets the time of day, see SettableClock.
// The machine's clock and monotonic clocks are unchanged.
#include <stdlib.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>

#include "clock_offset.hpp"

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

const cornerd::system_test::ClockOffset* find_offset() {
  using namespace cornerd::system_test;
  const char* file = ::getenv(kClockFileVariable);
  return file == nullptr ? nullptr : map_clock_offset(file);
}

timespec time_of_day() {
  static const auto* const offset_ns = find_offset();
  timespec machine{};
  ::syscall(SYS_clock_gettime, CLOCK_REALTIME, &machine);
  const std::int64_t ns = machine.tv_sec * kNsPerSecond + machine.tv_nsec +
                          (offset_ns == nullptr ? 0 : offset_ns->load());
  return {static_cast<time_t>(ns / kNsPerSecond), static_cast<long>(ns % kNsPerSecond)};
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  if (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE) {
    return static_cast<int>(::syscall(SYS_clock_gettime, clock, now));
  }
  *now = time_of_day();
  return 0;
}

int gettimeofday(timeval* now, void* /*zone*/) noexcept {
  const timespec time = time_of_day();
  *now = {time.tv_sec, time.tv_nsec / 1000};
  return 0;
}

time_t time(time_t* now) noexcept {
  const time_t seconds = time_of_day().tv_sec;
  if (now != nullptr) *now = seconds;
  return seconds;
}

}  // extern "C"
