// SPDX-License-Identifier: MIT
#pragma once

#include <termios.h>

#include <cstdint>
#include <optional>

namespace cornerd::drivers {

/// The termios constant of a baud rate; nullopt where there is none.
std::optional<speed_t> termios_speed(std::uint32_t baud);

}  // namespace cornerd::drivers
