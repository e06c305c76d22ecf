// SPDX-License-Identifier: MIT
#include "drivers/odometry/odometry_driver.hpp"

namespace cornerd::drivers {

std::string_view to_string(SensorState state) {
  switch (state) {
    case SensorState::kNone:
      return "none";
    case SensorState::kAbsent:
      return "absent";
    case SensorState::kUnreadable:
      return "unreadable";
    case SensorState::kDisabled:
      return "disabled";
    case SensorState::kInvalid:
      return "invalid";
    case SensorState::kStuck:
      return "stuck";
    case SensorState::kRunning:
      return "running";
  }
  return "unknown";
}

}  // namespace cornerd::drivers
