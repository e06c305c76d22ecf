// SPDX-License-Identifier: MIT
// Calibration of wheels and gyro from a recorded drive with known poses.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/dead_reckoning.hpp"
#include "calibration/drive_window.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/motion_filter.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// Bound of a scale; a fit that ends there means a wrong geometry.
inline constexpr double kMaxFittedScale = 0.5;

struct OdometryFit {
  core::OdometryParameters learned;
  core::OdometryParameters sigma;
  std::size_t windows = 0;
  bool has_gyro = false;
  /// The drive determines the delay; otherwise `learned` has the given one.
  bool has_delay = false;
};

/// Robust least squares over windows of about a second between known poses: translation by the
/// wheels, rotation by wheels and gyro, and the time delay of both, searched near `delay_s`.
/// Windows with slip are downweighted. The sigmas follow from the residuals (sandwich covariance).
/// Nullopt where the drive does not determine all parameters: too short, no rotations or no
/// straights.
std::optional<OdometryFit> fit_odometry(std::span<const core::OdometryIncrement> steps,
                                        std::span<const KnownPose> places,
                                        const core::DriveGeometry& geometry, double delay_s = 0);

}  // namespace cornerd::calibration
