// SPDX-License-Identifier: MIT
#include "drivers/lidar_fault.hpp"

namespace cornerd::drivers {

std::string_view to_string(LidarFault fault) {
  switch (fault) {
    case LidarFault::kNone:
      return "";
    case LidarFault::kNoPort:
      return "no-port";
    case LidarFault::kNoPermission:
      return "no-permission";
    case LidarFault::kPortHeld:
      return "port-held";
    case LidarFault::kPortError:
      return "port-error";
    case LidarFault::kUnplugged:
      return "unplugged";
    case LidarFault::kStreamRunning:
      return "stream-running";
    case LidarFault::kForeignTalk:
      return "foreign-talk";
    case LidarFault::kBooting:
      return "booting";
    case LidarFault::kNoAnswer:
      return "no-answer";
    case LidarFault::kWrongBaud:
      return "wrong-baud";
    case LidarFault::kProtectionStop:
      return "protection-stop";
    case LidarFault::kHealthError:
      return "health-error";
    case LidarFault::kNoSuchMode:
      return "no-such-mode";
    case LidarFault::kMotorControl:
      return "motor-control";
    case LidarFault::kNoData:
      return "no-data";
    case LidarFault::kMotorStalled:
      return "motor-stalled";
    case LidarFault::kRestarted:
      return "restarted";
    case LidarFault::kDeadLaser:
      return "dead-laser";
  }
  return "unknown";
}

}  // namespace cornerd::drivers
