// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "calibration/map_faults.hpp"
#include "settings/config.hpp"

namespace cornerd::settings {

/// What is wrong with `plan`, by its variants and the other maps of the config. Throws
/// SettingsError where one of these cannot be read. As calibration::find_map_fault().
std::optional<calibration::MapFinding> examine_map(const core::FloorPlan& plan,
                                                   const Config& config,
                                                   std::span<const calibration::ScanSamples> scans,
                                                   const std::function<bool()>& is_over);

}  // namespace cornerd::settings
