// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "calibration/drive_window.hpp"
#include "core/odometry/motion_step.hpp"
#include "core/odometry/reading_gate.hpp"
#include "drivers/rplidar/decoder.hpp"
#include "settings/config.hpp"
#include "tool/truth.hpp"

namespace cornerd::tool {

/// A drive by wheels and gyro, and where the robot was meanwhile.
struct RecordedDrive {
  std::vector<core::MotionStep> steps;
  std::vector<core::MotionStep> wide_steps;  ///< with whatever wheels and gyro say believed
  core::OdometryCounters counters;           ///< of `steps`
  std::vector<calibration::KnownPlace> places;
};

/// Places are the truth's, or the lidar's fixes where it is null. `straightened`: turns by what
/// wheels and gyro say, which gives better fixes where they are right. Throws
/// replay::RecordingError and settings::SettingsError.
RecordedDrive play_drive(const std::filesystem::path& file, std::optional<rplidar::WireFormat> wire,
                         const settings::Config& config, const Truth* truth, bool straightened);

}  // namespace cornerd::tool
