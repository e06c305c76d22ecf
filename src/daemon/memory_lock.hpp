// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::daemon {

/// Keeps all that is mapped now out of swap, threads' stacks and preallocated memory included, so
/// call it when all of that is there. What the server allocates later may be swapped: asked to lock
/// that too, the kernel would refuse it memory at the limit. Returns errno of a refusal, or 0.
int lock_memory();

}  // namespace cornerd::daemon
