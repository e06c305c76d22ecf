// SPDX-License-Identifier: MIT
// From an occupancy grid to a map of walls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// How the picture was made. A mapper marks the cells that beams ended in: the surface goes through
/// their middle on average. A drawing fills what is solid: the surface is on the cells' sides.
enum class MadeBy : std::uint8_t { kUnknown, kLidar, kDrawing };

struct ImportOptions {
  MadeBy made_by = MadeBy::kUnknown;  ///< unknown: the data decide
  double speck_m = 0.1;     ///< smallest occupied patch, at least 2.5 cells: legs of furniture stay
  double pocket_m2 = 0.05;  ///< smallest free patch
  double join_gap_m = 0.6;  ///< largest unknown gap within a wall
  double thickness_m = 0.6;    ///< thickest wall with unknown cells inside
  double thin_m = 0;           ///< thickness of walls thinner than a cell
  double roughness_m = 0.025;  ///< largest step of a mapped wall that is noise
  bool square = true;          ///< make walls square that are so within the raster's error
};

/// Something left out of the map, or closed without being seen.
struct Remark {
  core::Vec2 place = core::Vec2::Zero();  ///< in the map
  double size_m = 0;
};

struct ImportResult {
  /// Without a name. The two-sided walls come first, the rectangles last.
  core::FloorPlan plan;
  MadeBy made_by = MadeBy::kUnknown;
  double cell_m = 0;           ///< the picture's, or larger where those are finer than its noise
  std::size_t two_sided = 0;   ///< walls with both faces seen
  std::size_t rectangles = 0;  ///< patches beside the walls: chair legs, table edges
  std::vector<Remark> specks;
  std::vector<Remark> pockets;
  std::vector<Remark> short_pieces;
  std::vector<Remark> joined_gaps;
};

/// Walls along the borders between free and occupied cells; none where there is no border.
ImportResult import_grid(OccupancyGrid grid, double resolution_m, const core::Pose2& T_map_picture,
                         const ImportOptions& options);

}  // namespace cornerd::gridmap
