// SPDX-License-Identifier: MIT
// Breakpoint extraction (El Amin et al., section IV.B.4a): what the ends of the tracked walls are.
#pragma once

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/localizer_config.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// Looks at every pair of neighbouring walls. Where their lines meet between them there is a
/// corner, placed at the intersection: the paper's own point (step 14) is off by up to a sample's
/// spacing. Where a wall ends in front of something farther there is a terminal. Where something
/// nearer hides how the wall goes on there is nothing.
void extract_breakpoints(const PolarScan& scan, const SegmentTracks& tracks,
                         const DetectorConfig& config, const SensorNoise& noise,
                         Detection& detection);

}  // namespace cornerd::core
