// SPDX-License-Identifier: MIT
// How late the readings of a recorded drive are, roughly but from anywhere.
#pragma once

#include <span>

#include "calibration/drive_window.hpp"

namespace cornerd::calibration {

/// Readings later or earlier than this are not looked for.
inline constexpr double kMaxDelay_s = 0.6;

struct DelaySearch {
  double delay_s = 0;    ///< to a hundredth of a second, or the configured one
  bool is_told = false;  ///< this delay explains the drive, the configured and all others do not
  bool at_edge = false;  ///< it is told, and the true one may lie beyond what was searched
};

/// Of many delays the one with which the counts' and the gyro's share of the windows' ways and
/// turns explain them best, whatever those shares are: wheels and gyro may be off by anything.
/// Where nothing tells (constant speed, no turns) it is `configured_s`. Steps and places in the
/// order of time.
DelaySearch search_delay(std::span<const core::OdometryIncrement> steps,
                         std::span<const KnownPose> places, double configured_s);

}  // namespace cornerd::calibration
