// SPDX-License-Identifier: MIT
#include "drivers/lidar_status.hpp"

#include <algorithm>

namespace cornerd::drivers {

std::string_view to_string(LidarState state) {
  switch (state) {
    case LidarState::kAbsent:
      return "absent";
    case LidarState::kOpening:
      return "opening";
    case LidarState::kIdentifying:
      return "identifying";
    case LidarState::kStarting:
      return "starting";
    case LidarState::kRunning:
      return "running";
    case LidarState::kFaulty:
      return "faulty";
    case LidarState::kBackoff:
      return "backoff";
    case LidarState::kEnded:
      return "ended";
  }
  return "unknown";
}

std::string_view to_string(LidarFault fault) {
  switch (fault) {
    case LidarFault::kNone:
      return "";
    case LidarFault::kNoPort:
      return "no-port";
    case LidarFault::kNoPermission:
      return "no-permission";
    case LidarFault::kPortBusy:
      return "port-busy";
    case LidarFault::kPortError:
      return "port-error";
    case LidarFault::kUnplugged:
      return "unplugged";
    case LidarFault::kStreamRunning:
      return "stream-running";
    case LidarFault::kUnexpectedData:
      return "unexpected-data";
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
    case LidarFault::kNoScan:
      return "no-scan";
  }
  return "unknown";
}

std::string_view ShortText::view() const {
  const auto* const end = std::find(chars.begin(), chars.end(), '\0');
  return {chars.data(), static_cast<std::size_t>(end - chars.begin())};
}

void ShortText::set(std::string_view text) {
  chars.fill('\0');
  const std::size_t length = std::min(text.size(), chars.size() - 1);
  std::copy_n(text.begin(), length, chars.begin());
}

StreamCounters& operator+=(StreamCounters& sum, const StreamCounters& more) {
  for (const CounterName& counter : kCounterNames) sum.*counter.member += more.*counter.member;
  return sum;
}

}  // namespace cornerd::drivers
