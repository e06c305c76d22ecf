// SPDX-License-Identifier: MIT
// Drives along corridors, where most scans show two walls and little else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "bench/localization/pose_score.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::bench {

enum class CorridorRobot : std::uint8_t { kLidarAlone, kWheels, kWheelsAndGyro };

/// Drives to the end of a corridor along x, which begins at 0, and back, at 0.5 m/s, at most
/// `scans` scans.
PoseScore drive_along(const std::shared_ptr<const core::WallMap>& corridor, CorridorRobot robot,
                      std::size_t scans, std::uint64_t seed);

}  // namespace cornerd::bench
