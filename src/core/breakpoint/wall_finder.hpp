// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/breakpoint/segment_track.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// A method that finds the walls of a whole scan: what the baselines have in common.
class WallFinder {
 public:
  virtual ~WallFinder() = default;

  /// Walls of at least min_support samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  virtual std::size_t track(const PolarScan& scan, SegmentTracks& tracks) = 0;

 protected:
  WallFinder() = default;
  WallFinder(const WallFinder&) = default;
  WallFinder& operator=(const WallFinder&) = default;
};

}  // namespace cornerd::core
