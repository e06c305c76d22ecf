// SPDX-License-Identifier: MIT
#include "drivers/serial/file_descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace cornerd::drivers {

void occupy_standard_streams() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    // open() takes the lowest free number, which is this one.
    if (::fcntl(fd, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) != fd) return;
  }
}

}  // namespace cornerd::drivers
