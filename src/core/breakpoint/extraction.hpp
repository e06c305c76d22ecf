// SPDX-License-Identifier: MIT
// Breakpoint extraction (El Amin et al., section IV.B.4a): what the ends of the tracked walls are.
#pragma once

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_tests.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// Looks at the border of two neighbouring walls and adds what it shows to `detection`. Where their
/// lines meet between them there is a corner, placed at the intersection: the paper's own point
/// (step 14) is off by up to a sample's spacing. Where a wall ends in front of something farther
/// there is an edge: a corner where the face of its end gave returns, too, else a terminal. Where
/// something nearer hides how the wall goes on there is nothing.
void extract_border(const PolarScan& scan, const SegmentTrack& right, const SegmentTrack& left,
                    double corner_tolerance_m, const Judgement& by, Detection& detection);

WallSegment describe_wall(const PolarScan& scan, const SegmentTrack& wall, double noise_scale);

}  // namespace cornerd::core
