// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "drivers/lidar_status.hpp"
#include "drivers/serial/serial_port.hpp"

namespace cornerd::drivers {

/// One line for a person: where, what is wrong, what to do. `device`: the port. `extra`: a detail
/// of the fault, such as the health's text, a list of modes or a speed; may be empty.
std::string hint(LidarFault fault, std::string_view device, std::string_view extra = {});

/// What a port that cannot be opened means for its lidar.
struct PortFailure {
  LidarState state;
  LidarFault fault;
};

PortFailure failure_of(OpenError error);

}  // namespace cornerd::drivers
