// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace cornerd::daemon {

/// Sets the stack size of future threads to 512 kB. The default of 8 MB per thread would be locked
/// or populated unused.
void use_small_stacks();

/// Locks all memory that is mapped now, so call it after the threads exist. Later allocations of
/// the server are not locked, because they would fail at RLIMIT_MEMLOCK. Returns 0 or an errno.
int lock_memory();

/// Populates all pages that are mapped now; they may still be swapped. Used if locking is refused.
/// False before Linux 5.14.
bool prefault_memory();

/// Minor and major page faults of the calling thread.
std::uint64_t page_faults_of_thread();

}  // namespace cornerd::daemon
