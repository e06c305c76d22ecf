// SPDX-License-Identifier: MIT
// Unmapped obstacles: posts, legs of tables and chairs, boxes, closed doors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/map/wall_map.hpp"
#include "replay/simulator/scanned_path.hpp"
#include "replay/simulator/sensor_model.hpp"

namespace cornerd::replay {

/// Distance that clutter keeps from a path.
inline constexpr double kClutterClearance_m = 0.25;

struct Clutter {
  std::vector<core::Wall> walls;  ///< the obstacles as solids; legs are one wall each
  std::size_t obstacles = 0;
  double share = 0;  ///< of the rays that stop at them
};

/// Random obstacles in the free space of `world` until `share` of the rays within the field of view
/// and the maximum range stop at them before a wall, to about 2 percentage points. Deterministic
/// for the seed. Throws std::invalid_argument if the share is not in [0, 1] or the path is empty,
/// std::runtime_error with the share reached if there is no room for more.
Clutter place_clutter(const core::WallMap& world, const ScannedPath& path,
                      const SensorModel& sensor, double share, std::uint64_t seed);

}  // namespace cornerd::replay
