// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"

namespace cornerd::core {

/// What the robot's controller says at one time; any of it may be absent. Counts grow when the
/// robot rolls forward, the rate when it turns to the left.
struct OdometryReading {
  TimeNs t_ns = 0;
  std::optional<std::int64_t> left;   ///< encoder counts
  std::optional<std::int64_t> right;  ///< encoder counts
  std::optional<double> gyro_rad_s;
};

}  // namespace cornerd::core
