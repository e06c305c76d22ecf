// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"
#include "plan/drawing.hpp"

namespace cornerd::plan {

struct PairingOptions {
  double thickest_m = 0.6;  ///< parallel lines that are further apart are no faces of one wall
  double thin_m = 0;        ///< thickness of walls that are drawn as one line
};

struct PairedWalls {
  std::vector<core::Wall> walls;  ///< those with both faces come first
  std::size_t two_sided = 0;
};

/// From lines in metres to walls. Of parallel lines that face each other the nearest two are the
/// faces of one wall, where neither is already one of another; what closes the ends of such walls
/// is dropped; other lines are walls of their own. Lines on each other are one.
PairedWalls pair_walls(std::span<const DrawnLine> lines, const PairingOptions& options);

}  // namespace cornerd::plan
