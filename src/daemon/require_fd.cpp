// SPDX-License-Identifier: MIT
#include "daemon/require_fd.hpp"

#include <cerrno>
#include <system_error>

namespace cornerd::daemon {

FileDescriptor require_fd(int fd, const char* what) {
  if (fd < 0) throw std::system_error(errno, std::generic_category(), what);
  return FileDescriptor(fd);
}

}  // namespace cornerd::daemon
