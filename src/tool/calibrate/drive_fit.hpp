// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/odometry_fit.hpp"
#include "settings/config.hpp"
#include "tool/calibrate/calibration_drive.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

struct FittedDrive {
  CalibrationDrive drive;
  calibration::OdometryFit fit;
};

/// Plays a recorded drive and fits wheels and gyro: first the delay, then wiring faults, then
/// scales. Poses come from `truth`, or from the lidar's fixes if it is null. Throws Failure with
/// the fault, replay::RecordingError and settings::SettingsError.
FittedDrive fit_drive(const DriveFile& file, const settings::Config& config, const Truth* truth);

}  // namespace cornerd::tool
