// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "drivers/lidar_fault.hpp"

namespace cornerd::rplidar {

/// What is wrong and what to do about it, in one line for a person. `device`: the port; `extra`:
/// what the fault is about, as the health's text, a list of modes, or a speed; it may be empty.
std::string hint(drivers::LidarFault fault, std::string_view device, std::string_view extra = {});

}  // namespace cornerd::rplidar
