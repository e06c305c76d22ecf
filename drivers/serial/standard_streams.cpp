// SPDX-License-Identifier: MIT
#include "drivers/serial/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace cornerd::drivers {

void occupy_standard_streams() {
  for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
    // open() takes the lowest number that is free: this one, as those below are taken.
    if (::fcntl(fd, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) != fd) return;
  }
}

}  // namespace cornerd::drivers
