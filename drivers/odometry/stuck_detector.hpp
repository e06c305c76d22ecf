// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_reading.hpp"

namespace cornerd::drivers {

/// Detects a sensor whose value no longer changes although the other sensors report motion. A
/// broken encoder cable holds the last count, a hung gyro the last rate.
class StuckDetector {
 public:
  explicit StuckDetector(const core::DriveGeometry& geometry) : geometry_(geometry) {}

  /// Unwrapped counts. An absent value of a sensor resets its detection.
  void add(const core::OdometryReading& reading);

  bool left_is_stuck() const { return is_stuck(other_travel_left_m_); }
  bool right_is_stuck() const { return is_stuck(other_travel_right_m_); }
  bool gyro_is_stuck() const;

 private:
  bool is_stuck(double other_travel_m) const;

  core::DriveGeometry geometry_;
  core::OdometryReading last_;
  double other_travel_left_m_ = 0;  ///< travel of the right wheel since the left count last changed
  double other_travel_right_m_ = 0;  ///< and vice versa
  double turned_rad_ = 0;            ///< rotation by the wheels since the rate last changed
};

}  // namespace cornerd::drivers
