// SPDX-License-Identifier: MIT
// What a recorded drive, whose places are known, says of a robot's wheels and gyro.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "calibration/drive_window.hpp"
#include "core/geometry/pose2.hpp"
#include "core/odometry/dead_reckoning.hpp"
#include "core/odometry/fusion_filter.hpp"
#include "core/odometry/odometry_increment.hpp"

namespace cornerd::calibration {

/// A drive by wheels and gyro alone, from its first known place on.
struct DriveError {
  double mean_m = 0;  ///< over the known places
  double end_m = 0;   ///< at the last one
  std::size_t places = 0;
};

/// Where each of the known places after the first was thought to be.
using DrivePoints = std::vector<core::Vec2>;

/// Steps and places in the order of time, as everywhere here.
DriveError reckon(std::span<const core::OdometryIncrement> steps, std::span<const KnownPose> places,
                  const core::DriveGeometry& geometry, const core::DeadReckoningConfig& config,
                  DrivePoints* points = nullptr);
/// The same with what was learned, the delay included; the heading is the gyro's where there is
/// one.
DriveError reckon(std::span<const core::OdometryIncrement> steps, std::span<const KnownPose> places,
                  const core::DriveGeometry& geometry, const core::OdometryParameters& learned,
                  DrivePoints* points = nullptr);

/// A scale is believed to be no larger: one that ends there means that the geometry is wrong.
inline constexpr double kMaxFittedScale = 0.5;

struct OdometryFit {
  core::OdometryParameters learned;
  core::OdometryParameters sigma;
  std::size_t windows = 0;
  bool has_gyro = false;
  /// The drive tells the delay, else `learned` has the one that was given, and `sigma` how little
  /// is known of it.
  bool has_delay = false;
};

/// Least squares over windows of about a second from known place to known place: the way by the
/// wheels, the turn by wheels and gyro, and how late both are, which is looked for near `delay_s`.
/// Windows that fit badly (a slip) count less. The sigmas are those of the residuals themselves.
/// Nullopt where the drive does not tell them all: too short, without turns or without straights.
std::optional<OdometryFit> fit_odometry(std::span<const core::OdometryIncrement> steps,
                                        std::span<const KnownPose> places,
                                        const core::DriveGeometry& geometry, double delay_s = 0);

}  // namespace cornerd::calibration
