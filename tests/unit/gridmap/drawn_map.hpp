// SPDX-License-Identifier: MIT
// Pictures of a known building, and the errors of their import.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// A picture and where it lies.
struct DrawnMap {
  OccupancyGrid grid;
  double resolution_m;
  core::Pose2 T_map_picture;

  core::Vec2 to_cells(const core::Vec2& place) const {
    return T_map_picture.inverse() * place / resolution_m;
  }
  /// Free, so far in front of a surface.
  bool is_open(const core::Vec2& place, const core::Vec2& normal) const {
    return grid.at(to_cells(place + 1.5 * resolution_m * normal)) == Cell::kFree;
  }
};

/// A drawing: a cell is occupied where its middle is within a wall, or a wall's centre line crosses
/// it; unknown outside of the building. `yaw_rad`: of the picture relative to the building.
DrawnMap draw_map(const core::WallMap& map, double resolution_m, double yaw_rad);

/// A mapper's picture from beams every 0.5 degrees at random places: a cell is occupied where a
/// quarter of the beams that reached it ended in it. `sigma_m`: of their ranges. `drift_m`:
/// standard deviation of the mapper's poses, along both axes.
DrawnMap scan_map(const core::WallMap& map, double resolution_m, double yaw_rad, double sigma_m,
                  std::size_t places, double drift_m = 0);

/// P5, with map_server's own shades.
std::string to_pgm(const OccupancyGrid& grid);
std::string to_yaml(const DrawnMap& drawn, const std::string& image);

struct ImportScore {
  std::size_t corners = 0;              ///< of the building that face free cells
  std::vector<double> corner_errors_m;  ///< ascending, of those found
  std::size_t invented_corners = 0;
  double faces_m = 0;  ///< of the building's surfaces before free cells, longer than a few cells
  double missed_m =
      0;  ///< of that: no imported surface within 1.5 cells that looks the same direction
  double invented_m = 0;  ///< of imported surfaces before free cells

  double median_m() const {
    return corner_errors_m.empty() ? 0 : corner_errors_m[corner_errors_m.size() / 2];
  }
  double max_m() const { return corner_errors_m.empty() ? 0 : corner_errors_m.back(); }
  std::string text() const;
};

ImportScore score_import(const core::WallMap& truth, const core::WallMap& imported,
                         const DrawnMap& drawn);

}  // namespace cornerd::gridmap
