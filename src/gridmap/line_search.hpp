// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "gridmap/faces.hpp"
#include "gridmap/occupancy_grid.hpp"
#include "gridmap/solids.hpp"

namespace cornerd::gridmap {

/// Lengths in cells.
struct LineSearchOptions {
  double tolerance = 1.25;     ///< largest distance of a side from its line
  double join_gap = 20;        ///< largest unknown gap within a line
  double max_hole = 4;         ///< largest gap of free cells: noise, not an opening
  double min_score = 8;        ///< occupied slices, less the cost of gaps
  double min_joint_score = 4;  ///< of a line between two others
};

struct MappedLines {
  std::vector<GridFace> faces;
  std::vector<JoinedGap> gaps;
  double inset = 0.5;  ///< of the surfaces behind the sides of occupied cells
};

/// The straight surfaces of a map made by a lidar, each as long as noise and gaps allow.
MappedLines find_lines(const OccupancyGrid& grid, const LineSearchOptions& options);

/// Sets the cells along faces at a range of heights above them.
void draw_bands(const std::vector<GridFace>& faces, const Interval& heights, Cell kind,
                OccupancyGrid& grid);

}  // namespace cornerd::gridmap
