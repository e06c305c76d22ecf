// SPDX-License-Identifier: MIT
// Global search for the time delay of the odometry readings of a recorded drive.
#pragma once

#include <span>

#include "calibration/drive_window.hpp"

namespace cornerd::calibration {

/// Largest delay searched, in either direction.
inline constexpr double kMaxDelay_s = 0.6;

struct DelaySearch {
  double delay_s = 0;           ///< to a hundredth of a second, or the configured one
  bool is_unambiguous = false;  ///< clearly better than the configured one and all others
  bool at_edge = false;         ///< unambiguous, but the true one may lie beyond the search range
};

/// The delay for which translations and rotations of the windows fit the wheels and the gyro best,
/// with free scale factors. `configured_s` where the drive does not determine it (constant speed,
/// no rotations). `steps` and `places` are sorted by time.
DelaySearch search_delay(std::span<const core::OdometryIncrement> steps,
                         std::span<const KnownPose> places, double configured_s);

}  // namespace cornerd::calibration
