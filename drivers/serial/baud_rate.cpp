// SPDX-License-Identifier: MIT
// The kernel's header excludes <termios.h>, so this has a file of its own.
#include "drivers/serial/baud_rate.hpp"

#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace cornerd::drivers {

bool set_baud_rate(int fd, std::uint32_t baud) {
  termios2 settings{};
  if (::ioctl(fd, TCGETS2, &settings) != 0) return false;
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | CBAUD << IBSHIFT);
  settings.c_cflag |= BOTHER | BOTHER << IBSHIFT;
  settings.c_ospeed = baud;
  settings.c_ispeed = baud;
  return ::ioctl(fd, TCSETS2, &settings) == 0;
}

std::uint32_t baud_rate(int fd) {
  termios2 settings{};
  return ::ioctl(fd, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}

}  // namespace cornerd::drivers
