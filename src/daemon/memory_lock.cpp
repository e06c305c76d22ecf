// SPDX-License-Identifier: MIT
#include "daemon/memory_lock.hpp"

#include <sys/mman.h>

#include <cerrno>

namespace cornerd::daemon {

int lock_memory() { return ::mlockall(MCL_CURRENT) == 0 ? 0 : errno; }

}  // namespace cornerd::daemon
