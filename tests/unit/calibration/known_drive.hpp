// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "calibration/odometry_fit.hpp"

namespace cornerd::calibration {

/// What the wheels and the gyro of a known drive are off by.
inline const core::OdometryParameters kKnownErrors{0.01, 0.015, 0.025, -0.01, 0.02};

struct KnownDrive {
  std::vector<core::OdometryIncrement> steps;
  std::vector<KnownPose> places;
};

/// Straights and turns for a minute at 50 steps a second, known every 0.14 s; `turns`: 0 for none.
KnownDrive known_drive(const core::DriveGeometry& geometry, double scans, bool with_gyro = true);

}  // namespace cornerd::calibration
