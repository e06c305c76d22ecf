// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "tool/monitor/frame.hpp"
#include "tool/monitor/monitor_state.hpp"

namespace cornerd::tool {

/// What does not change while the monitor runs.
struct Scene {
  const core::WallMap* map = nullptr;  ///< null: what the lidar sees is drawn around itself
  core::Pose2 T_base_lidar;
};

/// What its keys change.
struct ViewChoice {
  bool unicode = true;      ///< else one dot a cell and ASCII alone
  bool lidar_view = false;  ///< what the lidar sees, around itself, instead of the map
  int zoom = 0;             ///< times two; above 0 the robot is in the middle
};

/// A part of a frame, in cells.
struct Region {
  std::size_t column = 0;
  std::size_t row = 0;
  std::size_t columns = 0;
  std::size_t rows = 0;
};

/// Walls, the last scan's returns, its corners (o) and ends of walls (x), the robot as an arrow
/// (dim where its pose is stale), and where it may be as well (?). Returns the width of a cell in
/// metres; 0 where nothing is drawn.
double draw_map(Frame& frame, const Region& region, const MonitorState& state, const Scene& scene,
                const ViewChoice& choice, core::TimeNs now_ns);

}  // namespace cornerd::tool
