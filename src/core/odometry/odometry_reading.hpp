// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"

namespace cornerd::core {

/// Sensor values of the robot's controller at one time; any may be absent. Counts grow when the
/// robot moves forward, the rate is positive to the left.
struct OdometryReading {
  TimeNs t_ns = 0;
  std::optional<std::int64_t> left;   ///< encoder counts
  std::optional<std::int64_t> right;  ///< encoder counts
  std::optional<double> gyro_rad_s;
};

}  // namespace cornerd::core
