// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "gridmap/faces.hpp"

namespace cornerd::gridmap {

inline constexpr std::size_t kNoRun = std::numeric_limits<std::size_t>::max();

/// A run, the two beside it on its border, and those that it goes on in.
struct LinkedRun {
  Run run;
  core::Vec2 begin = core::Vec2::Zero();  ///< where its border begins and ends
  core::Vec2 end = core::Vec2::Zero();
  std::size_t previous = kNoRun;
  std::size_t next = kNoRun;
  std::size_t continued_by = kNoRun;  ///< on the same line, with a wall in between
  std::size_t continues = kNoRun;
};

/// Turns runs along or square to the longest of them where their ends move by less than a part of a
/// cell: the picture cannot tell the difference, and two faces of one wall become parallel.
void square_up(std::vector<LinkedRun>& runs);

/// Finds the runs that go on in others behind what adjoins or what is unknown, and gives them one
/// line. Returns the unknown places.
std::vector<JoinedGap> continue_runs(const OccupancyGrid& grid, const FaceOptions& options,
                                     std::vector<LinkedRun>& runs);

}  // namespace cornerd::gridmap
