// SPDX-License-Identifier: MIT
#include "drivers/driver_clock.hpp"

#include <time.h>

#include <condition_variable>
#include <mutex>

namespace cornerd::drivers {
namespace {

core::TimeNs read_clock(clockid_t id) {
  timespec now{};
  ::clock_gettime(id, &now);
  return static_cast<core::TimeNs>(now.tv_sec) * core::kNsPerSecond + now.tv_nsec;
}

class SystemClock : public Clock {
 public:
  core::TimeNs monotonic_ns() override { return read_clock(CLOCK_MONOTONIC); }

  core::TimeNs unix_offset_ns() override {
    return read_clock(CLOCK_REALTIME) - read_clock(CLOCK_MONOTONIC);
  }

  void wait(std::chrono::milliseconds duration, const std::stop_token& stop) override {
    std::mutex mutex;
    std::condition_variable_any condition;
    std::unique_lock lock(mutex);
    condition.wait_for(lock, stop, duration, [] { return false; });
  }
};

}  // namespace

Clock& system_clock() {
  static SystemClock clock;
  return clock;
}

}  // namespace cornerd::drivers
