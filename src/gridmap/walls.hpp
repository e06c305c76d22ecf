// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/map/wall_map.hpp"
#include "gridmap/faces.hpp"
#include "gridmap/solids.hpp"

namespace cornerd::gridmap {

/// Faces that became no wall. In cells.
struct LeftOut {
  core::Vec2 centre = core::Vec2::Zero();
  double size = 0;
};

/// Walls of the faces that no solid covers, as thick as the occupied cells behind them, or lines.
/// Connected groups shorter than `min_size` that touch no solid go to `left_out`. All in cells.
std::vector<core::Wall> find_one_sided(const OccupancyGrid& grid, std::span<const GridFace> faces,
                                       std::span<const core::Wall> solids,
                                       const SolidLimits& limits, double min_size,
                                       std::vector<LeftOut>& left_out);

}  // namespace cornerd::gridmap
