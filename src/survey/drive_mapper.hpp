// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "core/localizer_config.hpp"
#include "survey/mapped_drive.hpp"
#include "survey/recorded_drive.hpp"

namespace cornerd::survey {

/// Called with the turns done.
using Progress = std::function<void(std::size_t)>;

/// Goes through a drive and maps it as it goes: each turn is placed by the faces mapped so far, and
/// what it saw beyond them begins new ones. `before`: an earlier, adjusted pass, whose faces are
/// known from the start, whose poses are better than any prediction, and whose odometry has
/// learned. `anew`: of that pass the way from turn to turn alone is believed, and nothing of its
/// map.
MappedDrive map_drive(const RecordedDrive& drive, const core::LocalizerConfig& config,
                      const MappedDrive* before, const Progress& progress, bool anew = false);

}  // namespace cornerd::survey
