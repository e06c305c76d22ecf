// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace cornerd::drivers {

/// What is wrong between the daemon and the lidar's measurements, as far as it can be told from
/// this end of the wire.
enum class LidarFault : std::uint8_t {
  kNone,
  kNoPort,          ///< no such file
  kNoPermission,    ///< it is there, and not for this user
  kPortHeld,        ///< another process has it
  kPortError,       ///< anything else that keeps it from being opened
  kUnplugged,       ///< it was open, and is gone
  kStreamRunning,   ///< still measuring for a program that never stopped it
  kForeignTalk,     ///< bytes come unasked, and are no measurement
  kBooting,         ///< has just been switched on: prints its banner
  kNoAnswer,        ///< silent to every question
  kWrongBaud,       ///< noise instead of answers, or answers at another speed
  kProtectionStop,  ///< its health has failed: laser and motor are off until a RESET
  kHealthError,     ///< its health has failed, and RESET did not mend it
  kNoSuchMode,      ///< the settings name a scan mode that it lacks
  kMotorControl,    ///< the line that switches its motor cannot be set
  kNoData,          ///< was told to measure, and never did
  kMotorStalled,    ///< measured, and fell silent
  kRestarted,       ///< printed its banner in the middle of measuring: its supply broke down
  kDeadLaser,       ///< turns and measures, and nothing returns
};

/// As STATUS calls it, "motor-stalled"; empty for kNone.
std::string_view to_string(LidarFault fault);

}  // namespace cornerd::drivers
