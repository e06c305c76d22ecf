// SPDX-License-Identifier: MIT
// Dead reckoning over a recorded drive with known poses. Increments and poses are sorted by time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calibration/dead_reckoning.hpp"
#include "calibration/drive_window.hpp"
#include "core/odometry/odometry_config.hpp"

namespace cornerd::calibration {

/// Position errors of dead reckoning from the first known pose on.
struct DriveError {
  double mean_m = 0;  ///< over the known poses
  double end_m = 0;   ///< at the last one
  std::size_t places = 0;
};

/// Estimated position at each known pose after the first.
using DrivePoints = std::vector<core::Vec2>;

/// By the paper's odometry.
DriveError reckon(std::span<const core::OdometryIncrement> steps, std::span<const KnownPose> places,
                  const core::DriveGeometry& geometry, const DeadReckoningConfig& config,
                  DrivePoints* points = nullptr);
/// By calibrated odometry, with its delay; the rotation is the gyro's where there is one.
DriveError reckon(std::span<const core::OdometryIncrement> steps, std::span<const KnownPose> places,
                  const core::DriveGeometry& geometry, const core::OdometryParameters& learned,
                  DrivePoints* points = nullptr);

/// The motion filter over a drive: corrected by the known poses at first, then dead reckoning.
struct FilteredDrive {
  DriveError alone;                ///< after the last correction
  std::vector<core::Vec2> points;  ///< at each known pose, before its correction
  core::OdometryParameters learned;
  std::uint64_t slips = 0;
};

/// Known poses up to `corrected_until_ns` correct the filter.
FilteredDrive filter_drive(std::span<const core::OdometryIncrement> steps,
                           std::span<const KnownPose> places, const core::OdometryConfig& config,
                           core::TimeNs corrected_until_ns);

}  // namespace cornerd::calibration
