// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/map/outline.hpp"
#include "gridmap/faces.hpp"

namespace cornerd::gridmap {

/// In cells.
struct SolidLimits {
  double thickness = 12;       ///< largest thickness with unknown cells inside
  double block = 200;          ///< largest thickness with occupied cells only
  double min_thickness = 0.4;  ///< a thinner wall is a line
  double tolerance = 0.7;      ///< distance of a face to a wall's side that is its own
  double wedge = 1;    ///< largest deviation from parallel of a wall's faces over their length
  bool lines = false;  ///< a wall seen from one side is a line: what is behind it is noise
  double thin = 0;     ///< thickness given to walls that would be lines
  double into = 0;     ///< overlap of a wall with the one it ends at: no ray passes between
};

/// Walls with both faces and no free cells in between, the thinnest first. In cells. Walls that
/// meet overlap.
std::vector<core::Wall> find_solids(const OccupancyGrid& grid, std::span<const GridFace> faces,
                                    const SolidLimits& limits);

struct Interval {
  double begin = 0;
  double end = 0;
  double length() const { return end - begin; }
};

/// The part of a face within `tolerance` cells of a wall; none where the wall is in front of it.
Interval covered(const GridFace& face, const core::WallBox& wall, double tolerance);

/// The rest of [0, length] without the given intervals, which may overlap.
std::vector<Interval> uncovered(double length, std::vector<Interval> covered);

}  // namespace cornerd::gridmap
