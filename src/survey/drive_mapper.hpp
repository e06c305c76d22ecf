// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "core/localizer_config.hpp"
#include "survey/mapped_drive.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::survey {

/// Called with the number of scans done.
using Progress = std::function<void(std::size_t)>;

/// Maps a drive scan by scan: each scan is matched to the faces mapped so far, and its unmatched
/// observations begin new faces. `before`: an earlier, adjusted pass that gives the initial faces,
/// the predicted poses and the odometry's calibration. `anew`: only the motion from scan to scan is
/// taken from that pass, not its map.
MappedDrive map_drive(const RecordedDrive& drive, const core::LocalizerConfig& config,
                      const MappedDrive* before, const Progress& progress, bool anew = false);

}  // namespace cornerd::survey
