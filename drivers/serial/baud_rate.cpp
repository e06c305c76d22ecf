// SPDX-License-Identifier: MIT
#include "drivers/serial/baud_rate.hpp"

namespace cornerd::drivers {

std::optional<speed_t> termios_speed(std::uint32_t baud) {
  switch (baud) {
    case 9600:
      return B9600;
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    case 230400:
      return B230400;
    case 460800:
      return B460800;
    case 921600:
      return B921600;
    case 1000000:
      return B1000000;
    default:
      return std::nullopt;
  }
}

}  // namespace cornerd::drivers
