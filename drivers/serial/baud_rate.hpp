// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace cornerd::drivers {

/// Any rate, by termios2: 128,000 and 256,000 baud have no constant in
/// termios. False, with
/// errno, if the port lacks it.
bool set_baud_rate(int fd, std::uint32_t baud);

/// 0 if it is not known.
std::uint32_t baud_rate(int fd);

}  // namespace cornerd::drivers
