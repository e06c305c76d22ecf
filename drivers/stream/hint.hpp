// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "drivers/lidar_status.hpp"

namespace cornerd::drivers {

/// One line for a person: where, what is wrong, what to do. `device`: the port. `extra`: a detail
/// of the fault, such as the health's text, a list of modes or a speed; may be empty.
std::string hint(LidarFault fault, std::string_view device, std::string_view extra = {});

}  // namespace cornerd::drivers
