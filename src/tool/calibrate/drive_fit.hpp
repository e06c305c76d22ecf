// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "calibration/odometry_fit.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "settings/config.hpp"
#include "tool/calibrate/recorded_drive.hpp"
#include "tool/replay/truth.hpp"

namespace cornerd::tool {

struct FittedDrive {
  RecordedDrive drive;
  calibration::OdometryFit fit;
};

/// Plays a recorded drive and fits wheels and gyro to it: first how late they are, then whether
/// anything is wrong that no scale makes up for, then the rest. Places are the truth's, or the
/// lidar's where it is null. Throws Failure, which says what is wrong or missing,
/// replay::RecordingError and settings::SettingsError.
FittedDrive fit_drive(const std::filesystem::path& file, std::optional<rplidar::WireFormat> wire,
                      const settings::Config& config, const Truth* truth);

}  // namespace cornerd::tool
