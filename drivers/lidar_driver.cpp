// SPDX-License-Identifier: MIT
#include "drivers/lidar_driver.hpp"

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

std::string_view ShortText::view() const {
  const auto* const end = std::find(chars.begin(), chars.end(), '\0');
  return {chars.data(), static_cast<std::size_t>(end - chars.begin())};
}

void ShortText::set(std::string_view text) {
  chars.fill('\0');
  const std::size_t length = std::min(text.size(), chars.size() - 1);
  std::copy_n(text.begin(), length, chars.begin());
}

}  // namespace cornerd::drivers
