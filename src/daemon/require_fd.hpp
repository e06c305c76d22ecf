// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/serial/file_descriptor.hpp"

namespace cornerd::daemon {

using drivers::FileDescriptor;

/// The result of a system call that makes a descriptor. Throws std::system_error.
FileDescriptor require_fd(int fd, const char* what);

}  // namespace cornerd::daemon
