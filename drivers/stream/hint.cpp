// SPDX-License-Identifier: MIT
#include "drivers/stream/hint.hpp"

namespace cornerd::drivers {
namespace {

/// {} stands for `extra`.
std::string_view pattern(LidarFault fault) {
  switch (fault) {
    case LidarFault::kNone:
      return "{}";
    case LidarFault::kNoPort:
    case LidarFault::kNoPermission:
      return "{}; waiting for it";
    case LidarFault::kPortBusy:
      return "{}; waiting for it. `sudo cornerctl doctor` names the process";
    case LidarFault::kPortError:
      return "{}; trying again. `sudo cornerctl doctor` finds the cause";
    case LidarFault::kUnplugged:
      return "the port vanished; waiting for it. If nobody unplugged it, check cable and supply";
    case LidarFault::kStreamRunning:
      return "still measuring for a program that ended without stopping it; stopped it";
    case LidarFault::kUnexpectedData:
      return "unexpected bytes that are no measurement of the configured lidar; is it one of "
             "another lidar.driver, another device, a console, or is advanced.lidar.baud set "
             "wrong?";
    case LidarFault::kBooting:
      return "just switched on; waiting until it has started";
    case LidarFault::kNoAnswer:
      return "no answer; check that it is {} baud (if not, set lidar.driver), that RX and TX are "
             "not swapped, and that it gets 5 V";
    case LidarFault::kWrongBaud:
      return "{}; set advanced.lidar.baud";
    case LidarFault::kProtectionStop:
      return "protection stop, {}; resetting it";
    case LidarFault::kHealthError:
      return "hardware fault that a reset does not clear, {}; check that its head turns freely and "
             "its supply holds 5 V";
    case LidarFault::kNoSuchMode:
      return "no scan mode {}";
    case LidarFault::kMotorControl:
      return "motor cannot be switched, {}; check the motor settings";
    case LidarFault::kNoData:
      return "never began to measure; check {}that its motor turns (belt, advanced.lidar.motor, "
             "5 V). Retrying";
    case LidarFault::kMotorStalled:
      return "stopped measuring; check that its head turns freely, its belt and its 5 V";
    case LidarFault::kRestarted:
      return "restarted by itself, as its supply drops below 4.9 V; use a stronger supply or a "
             "shorter cable";
    case LidarFault::kDeadLaser:
      return "its head turns, but nothing returns; check whether the laser is covered or dead";
    case LidarFault::kNoScan:
      return "measures, but its samples make no revolution; check that its head turns (belt, "
             "motor), and lidar.driver";
  }
  return "{}";
}

}  // namespace

std::string hint(LidarFault fault, std::string_view device, std::string_view extra) {
  const std::string_view text = pattern(fault);
  // The text of a port error names the port already.
  const bool is_named = fault >= LidarFault::kNoPort && fault <= LidarFault::kPortError;
  std::string line;
  if (!is_named) line.append(device).append(": ");
  const std::size_t position = text.find("{}");
  line.append(text.substr(0, position));
  if (position != std::string_view::npos) line.append(extra).append(text.substr(position + 2));
  return line;
}

PortFailure failure_of(OpenError error) {
  switch (error) {
    case OpenError::kAbsent:
      return {LidarState::kAbsent, LidarFault::kNoPort};
    case OpenError::kDenied:
      return {LidarState::kOpening, LidarFault::kNoPermission};
    case OpenError::kBusy:
      return {LidarState::kOpening, LidarFault::kPortBusy};
    case OpenError::kNone:
    case OpenError::kFailed:
      break;
  }
  return {LidarState::kOpening, LidarFault::kPortError};
}

}  // namespace cornerd::drivers
