// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/map/wall_map.hpp"
#include "gridmap/faces.hpp"
#include "gridmap/solids.hpp"

namespace cornerd::gridmap {

/// What did not become a wall. In cells.
struct LeftOut {
  core::Vec2 centre = core::Vec2::Zero();
  double size = 0;
};

/// What of the faces no solid covers: what was seen from one side, as thick as the picture has
/// occupied cells behind it, or a line where it has none. Groups of them that touch neither a solid
/// nor each other over `least` go to `left_out`. All in cells.
std::vector<core::Wall> find_one_sided(const OccupancyGrid& grid, std::span<const GridFace> faces,
                                       std::span<const core::Wall> solids,
                                       const SolidLimits& limits, double least,
                                       std::vector<LeftOut>& left_out);

}  // namespace cornerd::gridmap
