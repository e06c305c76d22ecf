// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "baseline/abd_iepf.hpp"
#include "baseline/line_tracking.hpp"
#include "baseline/printed_altbd.hpp"
#include "core/detector_config.hpp"

namespace cornerd::baseline {

/// For DetectorConfig::finder.
core::WallFinderFactory printed_altbd(const PrintedAltbdConfig& config = {});
core::WallFinderFactory abd_iepf(const AbdIepfConfig& config = {});
core::WallFinderFactory line_tracking(const LineTrackingConfig& config = {});

/// "altbd-printed", "abd-iepf" or "lt" with its defaults; empty (ALTBD) for any other name.
core::WallFinderFactory wall_finder(std::string_view name);

}  // namespace cornerd::baseline
