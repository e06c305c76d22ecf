// SPDX-License-Identifier: MIT
// Breakpoint extraction (El Amin et al., section IV.B.4a).
#pragma once

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_tests.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// Adds the breakpoints at the border of two neighbouring walls to `detection`. A corner, where
/// their lines meet between them, is the lines' intersection; the paper's own point (step 14) is
/// off by up to a sample's spacing. An edge, where a wall ends in front of something farther, is a
/// corner if its end face gave returns, else a terminal. An occluded end gives nothing.
void extract_border(const PolarScan& scan, const SegmentTrack& right, const SegmentTrack& left,
                    double corner_tolerance_m, const ExtractionContext& context,
                    Detection& detection);

WallSegment describe_wall(const PolarScan& scan, const SegmentTrack& wall, double noise_scale);

}  // namespace cornerd::core
