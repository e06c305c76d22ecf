// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "calibration/odometry_fit.hpp"

namespace cornerd::calibration {

/// Errors of the wheels and the gyro of a known drive.
inline const core::OdometryParameters kKnownErrors{0.01, 0.015, 0.025, -0.01, 0.02};

struct KnownDrive {
  std::vector<core::OdometryIncrement> steps;
  std::vector<KnownPose> places;
};

/// Straights and rotations for a minute at 50 Hz, with known poses every 0.14 s. `rotations`:
/// factor on the yaw rates.
KnownDrive known_drive(const core::DriveGeometry& geometry, double rotations,
                       bool with_gyro = true);

}  // namespace cornerd::calibration
