// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "survey/face_merging.hpp"
#include "survey/loop_search.hpp"

namespace cornerd::survey {

/// What became of a place that was recognised again.
struct LoopReport {
  std::size_t earlier = 0;  ///< turns: the one that was there first, and the later one
  std::size_t later = 0;
  std::size_t agreeing = 0;  ///< turns that were recognised there and agree
  double off_m = 0;          ///< what the drive was off by when it came back
  double off_rad = 0;
  std::string refused;  ///< why it was not closed; empty where it was
  bool closed() const { return refused.empty(); }
};

/// Looks through an adjusted drive for places that it came back to, and ties the turns there
/// together where nothing speaks against it: the way in between could have drifted so far, and the
/// walls seen on it do not contradict. A loop that is refused leaves the drive as it was. The drive
/// is adjusted again, and what is one wall then is merged; `merged` counts these.
std::vector<LoopReport> close_loops(MappedDrive& drive, const core::LocalizerConfig& sensor,
                                    const MergeLimits& merging, const WallLimits& walls,
                                    std::size_t& merged, const Progress& progress = {});

}  // namespace cornerd::survey
