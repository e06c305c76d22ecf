// SPDX-License-Identifier: MIT
#include "bench/nearest_corners.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/scoring.hpp"

namespace cornerd::bench {
namespace {

constexpr double kLeastBaseline_m = 0.10;

struct Recognised {
  core::Vec2 seen;    ///< lidar frame
  core::Vec2 on_map;  ///< map frame
};

std::optional<core::Vec2> corner_near(const core::WallMap& map, const core::Vec2& point) {
  std::optional<core::Vec2> nearest;
  double nearest_m = kMatchDistance_m;
  for (const core::Corner& corner : map.corners()) {
    const double distance_m = (corner.position - point).norm();
    if (distance_m > nearest_m) continue;
    nearest_m = distance_m;
    nearest = corner.position;
  }
  return nearest;
}

/// Recognised corners, the nearest to the sensor first.
std::vector<Recognised> recognise(std::span<const core::Breakpoint> breakpoints,
                                  const core::WallMap& map, const core::Pose2& T_map_lidar) {
  std::vector<Recognised> corners;
  for (const core::Breakpoint& breakpoint : breakpoints) {
    if (breakpoint.kind != core::BreakpointKind::kCorner) continue;
    const auto on_map = corner_near(map, T_map_lidar * breakpoint.position);
    if (on_map) corners.push_back({breakpoint.position, *on_map});
  }
  std::stable_sort(corners.begin(), corners.end(), [](const Recognised& a, const Recognised& b) {
    return a.seen.squaredNorm() < b.seen.squaredNorm();
  });
  return corners;
}

}  // namespace

std::optional<core::Pose2> pose_from_nearest_corners(std::span<const core::Breakpoint> breakpoints,
                                                    const core::WallMap& map,
                                                    const core::Pose2& T_map_lidar) {
  const std::vector<Recognised> corners = recognise(breakpoints, map, T_map_lidar);
  if (corners.size() < 2) return std::nullopt;
  const Recognised& first = corners.front();
  const auto second =
      std::find_if(corners.begin() + 1, corners.end(), [&](const Recognised& other) {
        return (other.on_map - first.on_map).norm() > kLeastBaseline_m;
      });
  if (second == corners.end()) return std::nullopt;

  const double theta_rad = core::normalize_angle(core::angle_of(second->on_map - first.on_map) -
                                                 core::angle_of(second->seen - first.seen));
  const core::Pose2 turned{0, 0, theta_rad};
  const core::Vec2 middle_of_seen = (first.seen + second->seen) / 2;
  const core::Vec2 place = (first.on_map + second->on_map) / 2 - turned * middle_of_seen;
  return core::Pose2{place.x(), place.y(), theta_rad};
}

}  // namespace cornerd::bench
