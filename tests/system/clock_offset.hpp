// SPDX-License-Identifier: MIT
// What SettableClock and the library that makes a process obey it have in common.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

namespace cornerd::system_test {

/// Nanoseconds that the time of day is ahead of the machine's.
using ClockOffset = std::atomic<std::int64_t>;
static_assert(ClockOffset::is_always_lock_free);

/// Names the file that holds the offset.
inline constexpr const char* kClockFileVariable = "CORNERD_TEST_CLOCK";

/// Shared with whoever maps the same file; null where that fails.
inline ClockOffset* map_clock_offset(const char* file) {
  const int fd = ::open(file, O_RDWR | O_CLOEXEC);
  if (fd < 0) return nullptr;
  void* memory = ::mmap(nullptr, sizeof(ClockOffset), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  ::close(fd);
  return memory == MAP_FAILED ? nullptr : static_cast<ClockOffset*>(memory);
}

}  // namespace cornerd::system_test
