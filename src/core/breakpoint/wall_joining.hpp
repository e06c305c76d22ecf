// SPDX-License-Identifier: MIT
#pragma once

#include "core/breakpoint/segment_track.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Neighbouring segments that are one wall become one: those that something small interrupts, and
/// the two ends of the wall that the seam at bearing +-pi cuts.
void join_walls(const PolarScan& scan, double noise_scale, SegmentTracks& tracks);

/// Gives each sample at the border of two neighbouring walls to the wall that it lies on. A tracker
/// runs a sample or two around a corner before it notices.
void settle_borders(const PolarScan& scan, const SensorNoise& noise, SegmentTracks& tracks);

}  // namespace cornerd::core
