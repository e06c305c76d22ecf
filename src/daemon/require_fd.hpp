// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <system_error>

#include "drivers/serial/file_descriptor.hpp"

namespace cornerd::daemon {

using drivers::FileDescriptor;

/// Takes ownership of `fd`, the result of the system call `what`. Throws std::system_error if it
/// failed.
inline FileDescriptor require_fd(int fd, const char* what) {
  if (fd < 0) throw std::system_error(errno, std::generic_category(), what);
  return FileDescriptor(fd);
}

}  // namespace cornerd::daemon
