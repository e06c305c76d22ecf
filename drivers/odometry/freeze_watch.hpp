// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_reading.hpp"

namespace cornerd::drivers {

/// Tells sensors that stopped to say anything new from a robot that stands: by what the others say
/// since a sensor's value last changed. A cable that broke holds its last count, a gyro that hung
/// itself up its last rate.
class FreezeWatch {
 public:
  explicit FreezeWatch(const core::DriveGeometry& geometry) : geometry_(geometry) {}

  /// Counts that do not wrap. What is absent says nothing.
  void add(const core::OdometryReading& reading);

  bool left_is_frozen() const { return is_frozen(left_still_m_); }
  bool right_is_frozen() const { return is_frozen(right_still_m_); }
  bool gyro_is_frozen() const;

 private:
  bool is_frozen(double other_wheel_m) const;

  core::DriveGeometry geometry_;
  core::OdometryReading last_;
  double left_still_m_ = 0;    ///< what the right wheel rolled since the left one last did
  double right_still_m_ = 0;   ///< and the other way round
  double rate_still_rad_ = 0;  ///< what the wheels turned the robot since the rate last changed
};

}  // namespace cornerd::drivers
