// SPDX-License-Identifier: MIT
// Trajectories of a simulated robot.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/types.hpp"

namespace cornerd::replay {

/// The pose of `base` in `map` at time `t_ns` since the start, during a scan. Scan 0 is the first
/// complete one; before it is scan -1.
using Motion = std::function<core::Pose2(core::TimeNs t_ns, std::int64_t scan)>;

Motion stand_still(const core::Pose2& T_map_base);

/// Rests at each pose for `scans_each` scans, then jumps to the next; stays at the last. Throws
/// std::invalid_argument if there is no pose or `scans_each` is not positive.
Motion visit_poses(std::vector<core::Pose2> poses, std::int64_t scans_each);

struct DriveConfig {
  double speed_m_s = 0.2;
  double yaw_rate_rad_s = 1.5;         ///< of rotations on the spot
  double acceleration_m_s2 = 0;        ///< 0: at once
  double yaw_acceleration_rad_s2 = 0;  ///< 0: at once
  bool loop = false;                   ///< from the last point back to the first, for ever
};

/// Drives straight from point to point, with rotations on the spot between them. Starts at the
/// first point, facing the second. Throws std::invalid_argument for fewer than two different points
/// or a rate that is not positive.
Motion drive_path(const std::vector<core::Vec2>& points, const DriveConfig& config);

/// Duration of the drive, or of one round if it loops.
double drive_duration_s(const std::vector<core::Vec2>& points, const DriveConfig& config);

/// A named drive through config/maps/flat-7.json.
struct Scenario {
  std::string_view name;
  std::vector<core::Vec2> path;  ///< closed: ends at the first point
};

/// After Bertocco et al. (2019), drawn from the figures: a short circuit with two sharp bends, a
/// longer one of right angles, and a full exploration.
std::span<const Scenario> scenarios();
/// nullptr if unknown.
const Scenario* find_scenario(std::string_view name);

}  // namespace cornerd::replay
