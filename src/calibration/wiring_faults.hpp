// SPDX-License-Identifier: MIT
// What is wrong with wheels or gyro beyond any scale: least squares without bounds of the way and
// the turn by the lidar on what the two encoders say, and of the turn on what the gyro says.
#pragma once

#include <optional>
#include <span>

#include "calibration/drive_window.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// A scale that the fit of odometry may well find is no fault. A drive that does not tell one (too
/// short, without turns) has none.
struct WiringFaults {
  bool left_is_stuck = false;  ///< its counts do not change while the wheel rolls
  bool right_is_stuck = false;
  bool are_swapped = false;       ///< what comes as left is the right wheel's
  bool left_is_reversed = false;  ///< what comes as left falls where it should grow
  bool right_is_reversed = false;
  /// How often its counts' way a wheel goes, where that is far from once; `left`: what comes as it.
  std::optional<double> left_factor;
  std::optional<double> right_factor;
  std::optional<double> track_m;  ///< where it is far from the configured one

  bool gyro_is_unrelated = false;  ///< to the robot's turns
  bool gyro_is_reversed = false;
  std::optional<double> gyro_factor;      ///< how often the true rate it reads, where far from once
  std::optional<double> gyro_bias_rad_s;  ///< where it is beyond what is believed

  /// By the wheels, or by the gyro where they are right.
  bool any() const;
};

/// `steps` by `geometry`; `windows` of cut_windows().
WiringFaults find_wiring_faults(std::span<const DriveWindow> windows,
                                const core::DriveGeometry& geometry);

/// The track that the turns of a drive ask for, metres; nullopt where it does not tell.
std::optional<double> apparent_track_m(std::span<const DriveWindow> windows);

}  // namespace cornerd::calibration
