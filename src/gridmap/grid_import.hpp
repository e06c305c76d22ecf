// SPDX-License-Identifier: MIT
// From a picture of cells to a map of walls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// Where in its cells the surface of a wall lies. A lidar's mapper marks the cells that beams ended
/// in: the surface goes through their middle on average. Who draws a picture fills what is solid.
enum class MadeBy : std::uint8_t { kUnknown, kLidar, kDrawing };

struct ImportOptions {
  MadeBy made_by = MadeBy::kUnknown;  ///< unknown: see detect_maker()
  double speck_m = 0.1;               ///< smaller than this, or than 2.5 cells, nothing is a wall
  double pocket_m2 = 0.05;            ///< smaller than this no free space is a room
  double join_gap_m = 0.3;            ///< unknown stretch of a wall that goes on behind it
  double thickness_m = 0.6;           ///< the thickest wall whose inside is unknown
  double thin_m = 0;           ///< of walls so thin that the picture has no thickness for them
  double roughness_m = 0.025;  ///< steps of a lidar's walls that are none
  bool square = true;          ///< make square what is so as far as the picture tells
};

/// What did not become a wall, or was taken as one without being seen.
struct Remark {
  core::Vec2 place = core::Vec2::Zero();  ///< in the map
  double size_m = 0;
};

struct ImportResult {
  /// Without a name; no walls where the picture has no border. The two-sided walls come first.
  core::FloorPlan plan;
  MadeBy made_by = MadeBy::kUnknown;
  std::size_t two_sided = 0;  ///< of the walls: those both of whose faces were seen
  std::vector<Remark> specks;
  std::vector<Remark> pockets;
  std::vector<Remark> short_pieces;
  std::vector<Remark> joined_gaps;
};

/// Drawn, where nothing is unknown, or much is occupied that no beam could have reached.
MadeBy detect_maker(const OccupancyGrid& grid);

/// Walls along the borders between free and occupied cells. Never fails; a picture without a border
/// gives no walls.
ImportResult import_grid(OccupancyGrid grid, double resolution_m, const core::Pose2& T_map_picture,
                         const ImportOptions& options);

}  // namespace cornerd::gridmap
