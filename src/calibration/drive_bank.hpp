// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "calibration/drive_faults.hpp"
#include "calibration/drive_model.hpp"

namespace cornerd::calibration {

/// Priors, before normalization: right; one fault; two at once.
inline constexpr double kPriorRight = 1;
inline constexpr double kPriorFault = 0.01;
inline constexpr double kPriorTwoFaults = 1e-4;
/// A wheel's factor is one of any between 1 / kLargestFactor and kLargestFactor, each as likely on
/// a logarithmic scale; a cell of them is as wide as the errors of measured wheels.
inline constexpr double kLargestFactor = 1000;
inline const double kFactorCells =
    2 * std::log(kLargestFactor) / (kMeasuredSigma * std::sqrt(2 * core::kPi));
/// Nearer to 1 a factor is none.
inline constexpr double kMinFactorChange = 0.25;
/// Windows with less do not tell of a factor.
inline constexpr double kMinRotation_rad = 0.1;

/// What may be wrong with wheels, times and mount, each with the logarithm of its posterior, not
/// normalized. The first is that nothing is.
std::vector<DriveHypothesis> drive_bank(std::span<const MotionWindow> windows,
                                        const core::Pose2& T_base_lidar,
                                        const core::DriveGeometry& geometry);

/// The mount by a fit with right wheels.
DriveHypothesis fit_free_mount(std::span<const MotionWindow> windows,
                               const core::Pose2& T_base_lidar,
                               const core::DriveGeometry& geometry);

}  // namespace cornerd::calibration
