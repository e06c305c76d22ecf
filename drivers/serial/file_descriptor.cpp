// SPDX-License-Identifier: MIT
#include "drivers/serial/file_descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace cornerd::drivers {

void occupy_standard_streams() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    // A write to a closed standard output fails, as it would have. open() takes the lowest free
    // number, which is fd.
    const int flags = fd == STDOUT_FILENO ? O_RDONLY : O_RDWR;
    if (::fcntl(fd, F_GETFD) < 0 && ::open("/dev/null", flags) != fd) return;
  }
}

}  // namespace cornerd::drivers
