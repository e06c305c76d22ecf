// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "replay/simulator/motion.hpp"

namespace cornerd::replay {

/// Where a lidar takes scans, and what its robot passes over.
struct ScannedPath {
  std::vector<core::Pose2> T_map_lidar;  ///< of at most 100 scans, evenly distributed
  std::vector<core::Vec2> points;        ///< of robot and lidar, at most 2 cm apart while driving
};

/// The path of the scans 0 to `scans` - 1 at a rate in Hz. Throws std::invalid_argument unless both
/// are positive.
ScannedPath scanned_path(const Motion& motion, const core::Pose2& T_base_lidar, std::int64_t scans,
                         double rate_hz);

}  // namespace cornerd::replay
