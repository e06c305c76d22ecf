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
  const core::WallMap* map = nullptr;  ///< null: the scan is drawn around the lidar
  core::Pose2 T_base_lidar;
};

/// The settings that keys change.
struct ViewChoice {
  bool unicode = true;      ///< else one dot a cell and ASCII alone
  bool lidar_view = false;  ///< the scan around the lidar instead of the map
  int zoom = 0;             ///< times two; above 0 the robot is in the middle
};

/// A part of a frame, in cells.
struct Region {
  std::size_t column = 0;
  std::size_t row = 0;
  std::size_t columns = 0;
  std::size_t rows = 0;
};

/// Draws walls, the last scan's returns, corners (o) and wall ends (x), the robot as an arrow (dim
/// if its pose is stale) and alternatives (?). Returns the width of a cell in metres; 0 if nothing
/// is drawn.
double draw_map(Frame& frame, const Region& region, const MonitorState& state, const Scene& scene,
                const ViewChoice& choice, core::TimeNs now_ns);

}  // namespace cornerd::tool
