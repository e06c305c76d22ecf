// SPDX-License-Identifier: MIT
// Where a simulated robot is at any time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::replay {

/// The pose of `base` in `map`, at a time since the start and in a turn of the sensor. Turn 0 is
/// the first whole one; what comes before it is turn -1.
using Motion = std::function<core::Pose2(core::TimeNs t_ns, std::int64_t scan)>;

Motion stand_still(const core::Pose2& T_map_base);

/// Stands at each place for some turns of the sensor, then is at the next one at once; stays at the
/// last. Throws std::invalid_argument where `places` is empty or `scans_each` is not positive.
Motion visit_poses(std::vector<core::Pose2> places, std::int64_t scans_each);

struct DriveConfig {
  double speed_m_s = 0.2;
  double yaw_rate_rad_s = 1.5;         ///< while it turns on the spot
  double acceleration_m_s2 = 0;        ///< 0: at once
  double yaw_acceleration_rad_s2 = 0;  ///< 0: at once
  bool loop = false;                   ///< from the last point back to the first, for ever
};

/// Drives straight from point to point and turns on the spot in between, as a robot with two wheels
/// does. It starts at the first point, looking at the second; at the end it stands, unless it
/// loops. Throws std::invalid_argument for fewer than two different points, or a rate that is not
/// positive.
Motion drive_path(const std::vector<core::Vec2>& points, const DriveConfig& config);

/// How long that takes, once around where it loops.
double drive_duration_s(const std::vector<core::Vec2>& points, const DriveConfig& config);

/// A drive through config/maps/flat-7.json that has a name.
struct Scenario {
  std::string_view name;
  std::vector<core::Vec2> path;  ///< from point to point, and back to the first
};

/// After Bertocco et al. (2019), whose flat and paths are known by small pictures alone: a short
/// circuit with two sharp turns, a longer one of right angles, and a full exploration.
std::span<const Scenario> scenarios();
/// nullptr where there is none of this name.
const Scenario* find_scenario(std::string_view name);

}  // namespace cornerd::replay
