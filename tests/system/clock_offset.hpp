// SPDX-License-Identifier: MIT
// Shared by SettableClock and the preloaded library clock_preload.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

namespace cornerd::system_test {

/// Offset of the time of day from the machine's, nanoseconds.
using ClockOffset = std::atomic<std::int64_t>;
static_assert(ClockOffset::is_always_lock_free);

/// Environment variable with the path of the file that holds the offset.
inline constexpr const char* kClockFileVariable = "CORNERD_TEST_CLOCK";

/// Shared by all processes that map the file; null on failure.
inline ClockOffset* map_clock_offset(const char* file) {
  const int fd = ::open(file, O_RDWR | O_CLOEXEC);
  if (fd < 0) return nullptr;
  void* memory = ::mmap(nullptr, sizeof(ClockOffset), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  ::close(fd);
  return memory == MAP_FAILED ? nullptr : static_cast<ClockOffset*>(memory);
}

}  // namespace cornerd::system_test
