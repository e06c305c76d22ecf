// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "gridmap/faces.hpp"

namespace cornerd::gridmap {

inline constexpr std::size_t kNoRun = std::numeric_limits<std::size_t>::max();

/// A run with its neighbours on the border, and its continuations on the same line.
struct LinkedRun {
  Run run;
  core::Vec2 begin = core::Vec2::Zero();  ///< where its border begins and ends
  core::Vec2 end = core::Vec2::Zero();
  std::size_t previous = kNoRun;
  std::size_t next = kNoRun;
  std::size_t continued_by = kNoRun;  ///< on the same line, with a wall in between
  std::size_t continues = kNoRun;
};

/// Makes runs parallel or square to the longest where that moves their ends by less than the
/// raster's error. Both faces of a wall then become parallel.
void square_up(std::vector<LinkedRun>& runs);

/// Finds runs that continue others behind an adjoining wall or an unknown gap, and gives them one
/// line. Returns the unknown gaps.
std::vector<JoinedGap> continue_runs(const OccupancyGrid& grid, const FaceOptions& options,
                                     std::vector<LinkedRun>& runs);

}  // namespace cornerd::gridmap
