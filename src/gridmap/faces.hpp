// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "gridmap/border_runs.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// Lengths in cells.
struct FaceOptions {
  double tolerance = 0.75;  ///< of straight_runs()
  double inset = 0;         ///< distance of the surface behind the border
  double join_gap = 6;      ///< largest unknown gap within a wall
  bool square = true;       ///< make faces square that are so within the raster's error
};

/// A straight wall surface, with free space on its left. In cells.
struct GridFace {
  core::Vec2 from = core::Vec2::Zero();
  core::Vec2 to = core::Vec2::Zero();
  core::Vec2 direction = core::Vec2::Zero();  ///< unit vector
  bool is_joint = false;     ///< closes a step or an end too short for a line of its own
  bool enters_from = false;  ///< another face comes out of the same solid there: a room's corner
  bool enters_to = false;

  core::Vec2 normal() const { return core::rotate_left(direction); }
  double along(const core::Vec2& point) const { return direction.dot(point - from); }
  double height_of(const core::Vec2& point) const { return normal().dot(point - from); }
  double length() const { return along(to); }
};

/// An unknown gap that was closed, since the wall continues behind it.
struct JoinedGap {
  core::Vec2 centre = core::Vec2::Zero();
  double length = 0;
};

struct FaceSet {
  std::vector<GridFace> faces;
  std::vector<JoinedGap> gaps;
};

/// Fits lines to all borders; they end at the corner of two, or where the border ends.
FaceSet build_faces(const OccupancyGrid& grid, std::vector<Border> borders,
                    const FaceOptions& options);

}  // namespace cornerd::gridmap
