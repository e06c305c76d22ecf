// SPDX-License-Identifier: MIT
// Faults of wiring and units, beyond scale errors: unbounded least squares of the lidar's
// translation and rotation on the two wheels, and of its rotation on the gyro.
#pragma once

#include <optional>
#include <span>

#include "calibration/drive_window.hpp"
#include "core/odometry/odometry_config.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// Scale errors within reach of fit_odometry() are no fault. A drive that does not determine a
/// fault (too short, without rotations) has none.
struct WiringFaults {
  bool left_is_stuck = false;  ///< the counts do not change while the wheel rolls
  bool right_is_stuck = false;
  bool are_swapped = false;       ///< the left field has the right wheel's counts
  bool left_is_reversed = false;  ///< the left field falls where it should grow
  bool right_is_reversed = false;
  /// True over counted distance, where far from 1; `left`: of the left field.
  std::optional<double> left_factor;
  std::optional<double> right_factor;
  std::optional<double> track_m;  ///< true track, where far from the configured one

  bool gyro_is_unrelated = false;  ///< does not measure the robot's rotations
  bool gyro_is_reversed = false;
  std::optional<double> gyro_factor;      ///< measured over true rate, where far from 1
  std::optional<double> gyro_bias_rad_s;  ///< where beyond the fit's bound

  bool any() const;
};

/// `windows`: of cut_windows(), with distances by `geometry`.
WiringFaults find_wiring_faults(std::span<const DriveWindow> windows,
                                const core::DriveGeometry& geometry);

/// The track (m) that a drive's rotations imply; nullopt where they do not determine it.
std::optional<double> apparent_track_m(std::span<const DriveWindow> windows);

}  // namespace cornerd::calibration
