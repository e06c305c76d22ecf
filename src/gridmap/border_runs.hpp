// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/breakpoint/line_fit.hpp"
#include "gridmap/border.hpp"

namespace cornerd::gridmap {

/// A straight part of a border. Lengths in cells.
struct Run {
  std::size_t begin = 0;  ///< sides of cells [begin, end) of the border
  std::size_t end = 0;
  core::Vec2 at = core::Vec2::Zero();  ///< a point of its line: the centroid of its sides
  core::Vec2 direction =
      core::Vec2::Zero();  ///< unit vector along it; the free space is on the left
  double extent = 0;       ///< from its first side to its last
  core::LineFit fit;       ///< of the middles of its sides, without those at its ends

  std::size_t size() const { return end - begin; }
  core::Vec2 normal() const { return core::rotate_left(direction); }
  double height_of(const core::Vec2& point) const { return normal().dot(point - at); }
};

/// Splits a border into few straight runs within `tolerance` cells of it. The raster displaces a
/// straight line by up to half a cell; smaller steps vanish. A closed border is rotated to begin at
/// a corner.
std::vector<Run> straight_runs(Border& border, double tolerance);

/// Share of the borders that is in straight runs, as a wall's is that no noise displaced: of those
/// that have room for a straight run, and of all, those of specks too.
struct Straightness {
  double of_long = 1;
  double of_all = 1;
};
Straightness straightness(const OccupancyGrid& grid);

/// Fits a run's line by least squares.
void fit_run(const Border& border, Run& run);

}  // namespace cornerd::gridmap
