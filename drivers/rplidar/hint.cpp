// SPDX-License-Identifier: MIT
#include "drivers/rplidar/hint.hpp"

namespace cornerd::rplidar {
namespace {

using drivers::LidarFault;

/// {} stands for what the fault is about.
std::string_view pattern(LidarFault fault) {
  switch (fault) {
    case LidarFault::kNone:
      return "{}";
    case LidarFault::kNoPort:
    case LidarFault::kNoPermission:
      return "{}; waiting for it";
    case LidarFault::kPortHeld:
      return "{}; waiting for it. `sudo cornerctl doctor` says by whom";
    case LidarFault::kPortError:
      return "{}; trying again. `sudo cornerctl doctor` says more";
    case LidarFault::kUnplugged:
      return "the port is gone; waiting for it. If nobody pulled the plug: check cable and supply";
    case LidarFault::kStreamRunning:
      return "was still measuring for a program that ended without stopping it; stopped it";
    case LidarFault::kForeignTalk:
      return "something talks on the port that is no lidar's measurement; another device, a "
             "console, a wrong advanced.lidar.baud?";
    case LidarFault::kBooting:
      return "has just been switched on; waiting until it has started";
    case LidarFault::kNoAnswer:
      return "no answer; is it an RPLidar with {} baud, are its RX and TX the right way round, has "
             "it 5 V enough?";
    case LidarFault::kWrongBaud:
      return "no answer at the speed of the settings, but {}; set advanced.lidar.baud";
    case LidarFault::kProtectionStop:
      return "has stopped to protect itself, {}; resetting it";
    case LidarFault::kHealthError:
      return "reports a hardware fault that a reset does not mend, {}; check that its head turns "
             "freely and its supply holds 5 V";
    case LidarFault::kNoSuchMode:
      return "has no mode {}";
    case LidarFault::kMotorControl:
      return "motor: {}";
    case LidarFault::kNoData:
      return "never began to measure; does its motor turn (belt, advanced.lidar.motor, 5 V)? "
             "Starting anew";
    case LidarFault::kMotorStalled:
      return "stopped measuring; is its head blocked, has its motor lost the belt or its 5 V?";
    case LidarFault::kRestarted:
      return "restarted by itself; its supply drops below 4.9 V: a stronger one, a shorter cable";
    case LidarFault::kDeadLaser:
      return "its head turns, but nothing returns; is the laser covered, or dead?";
  }
  return "{}";
}

}  // namespace

std::string hint(LidarFault fault, std::string_view device, std::string_view extra) {
  const std::string_view text = pattern(fault);
  // The port's own errors name it.
  const bool is_named = fault >= LidarFault::kNoPort && fault <= LidarFault::kPortError;
  std::string line;
  if (!is_named) line.append(device).append(": ");
  const std::size_t place = text.find("{}");
  line.append(text.substr(0, place));
  if (place != std::string_view::npos) line.append(extra).append(text.substr(place + 2));
  return line;
}

}  // namespace cornerd::rplidar
