// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/line_fit.hpp"

namespace cornerd::core {

/// A wall as a detector works on it: which samples, and the line through them.
struct SegmentTrack {
  LineFit fit;
  Line line;
  std::uint32_t first = 0;  ///< index into the PolarScan
  std::uint32_t last = 0;   ///< inclusive; smaller than `first` for a wall across the seam
  std::uint32_t support = 0;
};

/// The walls of a turn, counter-clockwise. Reserved for kMaxSegmentsPerTurn at construction.
using SegmentTracks = std::vector<SegmentTrack>;

}  // namespace cornerd::core
