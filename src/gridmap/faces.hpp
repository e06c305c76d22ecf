// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "gridmap/border_runs.hpp"
#include "gridmap/occupancy_grid.hpp"

namespace cornerd::gridmap {

/// How borders become faces. Lengths in cells.
struct FaceOptions {
  double tolerance = 0.75;  ///< of straight_runs()
  double inset = 0;         ///< the surface lies so far behind the border
  double join_gap = 6;      ///< unknown cells between two stretches of one wall
  bool square = true;       ///< make square what is so as far as the picture tells
};

/// A straight piece of wall surface, free space on the left of the way. In cells.
struct GridFace {
  core::Vec2 from = core::Vec2::Zero();
  core::Vec2 to = core::Vec2::Zero();
  core::Vec2 way = core::Vec2::Zero();  ///< unit vector; of its line, which both points are on
  bool is_joint = false;                ///< closes a step or an end too short for a line of its own
  bool enters_from = false;  ///< another face comes out of the same solid there: a room's corner
  bool enters_to = false;

  core::Vec2 normal() const { return core::rotate_left(way); }
  double along(const core::Vec2& point) const { return way.dot(point - from); }
  double height_of(const core::Vec2& point) const { return normal().dot(point - from); }
  double length() const { return along(to); }
};

/// A place where unknown cells were taken as wall, because the wall goes on behind them.
struct JoinedGap {
  core::Vec2 centre = core::Vec2::Zero();
  double length = 0;
};

struct FaceSet {
  std::vector<GridFace> faces;
  std::vector<JoinedGap> gaps;
};

/// Lines fitted to all borders, and where they end: in the corner of two, or where the border does.
FaceSet build_faces(const OccupancyGrid& grid, std::vector<Border> borders,
                    const FaceOptions& options);

}  // namespace cornerd::gridmap
