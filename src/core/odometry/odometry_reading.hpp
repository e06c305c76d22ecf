// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/types.hpp"

namespace cornerd::core {

/// Sensor values of the robot's controller at one time; any may be absent. Counts grow when the
/// robot moves forward, the rate is positive to the left.
struct OdometryReading {
  TimeNs t_ns = 0;                         ///< as stamped by the client
  std::optional<std::int64_t> left = {};   ///< encoder counts
  std::optional<std::int64_t> right = {};  ///< encoder counts
  std::optional<double> gyro_rad_s = {};
  /// When it was read; the lidar's newest sample then, where a recording does not tell.
  std::optional<TimeNs> arrival_ns = {};

  OdometryReading arrived(std::optional<TimeNs> at_ns) const {
    OdometryReading reading = *this;
    reading.arrival_ns = at_ns;
    return reading;
  }
};

}  // namespace cornerd::core
