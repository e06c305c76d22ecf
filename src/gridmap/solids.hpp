// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/map/outline.hpp"
#include "gridmap/faces.hpp"

namespace cornerd::gridmap {

/// In cells.
struct SolidLimits {
  double thickness = 12;  ///< with unknown cells between both faces
  double block = 200;     ///< with occupied cells alone
  double least = 0.4;     ///< thinner than this a wall is a line
  double slack = 0.7;     ///< a face this near to a wall's side is its side
  double thin = 0;        ///< thickness of the walls that would be lines
  double into = 0;        ///< how far a wall goes into what it ends at: no ray slips through
};

/// The walls both of whose faces are there, with nothing free in between, the thinnest first. In
/// cells. Walls that meet overlap.
std::vector<core::Wall> find_solids(const OccupancyGrid& grid, std::span<const GridFace> faces,
                                    const SolidLimits& limits);

/// A stretch along something.
struct Stretch {
  double begin = 0;
  double end = 0;
  double length() const { return end - begin; }
};

/// The part of a face within `slack` cells of a wall; none where the wall stands before the face.
Stretch covered(const GridFace& face, const core::WallBox& wall, double slack);

/// What is left of [0, length] without the given stretches, which may overlap.
std::vector<Stretch> uncovered(double length, std::vector<Stretch> covered);

}  // namespace cornerd::gridmap
