// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace cornerd::daemon {

/// Threads that are made from now on get this little stack: locked or touched beforehand, the usual
/// 8 MB of each would be memory that nobody uses.
void use_small_stacks();

/// Keeps all that is mapped now out of swap, threads' stacks and preallocated memory included, so
/// call it when all of that is there. What the server allocates later may be swapped: asked to lock
/// that too, the kernel would refuse it memory at the limit. Returns errno of a refusal, or 0.
int lock_memory();

/// Gives every page that is mapped now its memory, so that nobody waits for one later; it may still
/// be swapped. For where locking is refused. False on kernels that cannot, those before 5.14.
bool prefault_memory();

/// Page faults of the calling thread so far, those that took no I/O included.
std::uint64_t page_faults_of_thread();

}  // namespace cornerd::daemon
