// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "survey/face_merging.hpp"
#include "survey/loop_detection.hpp"

namespace cornerd::survey {

/// A detected loop, and whether it was closed.
struct LoopReport {
  std::size_t earlier = 0;  ///< scan indices
  std::size_t later = 0;
  std::size_t agreeing = 0;  ///< scans that agree on the loop constraint
  double off_m = 0;          ///< drift that the loop closure corrects
  double off_rad = 0;
  std::string refused;  ///< reason for rejecting it; empty where it was closed
  bool closed() const { return refused.empty(); }
};

/// Detects loops in an adjusted drive and closes those that pass two checks: the drift is within
/// the drive's covariance, and the walls in between do not contradict it. Each closed loop adjusts
/// the drive again and merges its faces; `merged` counts these. A rejected loop changes nothing.
std::vector<LoopReport> close_loops(MappedDrive& drive, const core::LocalizerConfig& sensor,
                                    const MergeLimits& merging, const WallLimits& walls,
                                    std::size_t& merged, const Progress& progress = {});

}  // namespace cornerd::survey
