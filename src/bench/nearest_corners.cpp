// SPDX-License-Identifier: MIT
#include "bench/nearest_corners.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/scoring.hpp"

namespace cornerd::bench {
namespace {

constexpr double kMinBaseline_m = 0.10;

struct MatchedCorner {
  core::Vec2 measured;  ///< lidar frame
  core::Vec2 on_map;    ///< map frame
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

/// Ascending by distance from the sensor.
std::vector<MatchedCorner> match_corners(std::span<const core::Breakpoint> breakpoints,
                                         const core::WallMap& map, const core::Pose2& T_map_lidar) {
  std::vector<MatchedCorner> corners;
  for (const core::Breakpoint& breakpoint : breakpoints) {
    if (breakpoint.kind != core::BreakpointKind::kCorner) continue;
    const auto on_map = corner_near(map, T_map_lidar * breakpoint.position);
    if (on_map) corners.push_back({breakpoint.position, *on_map});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const MatchedCorner& a, const MatchedCorner& b) {
                     return a.measured.squaredNorm() < b.measured.squaredNorm();
                   });
  return corners;
}

}  // namespace

std::optional<core::Pose2> pose_from_nearest_corners(std::span<const core::Breakpoint> breakpoints,
                                                     const core::WallMap& map,
                                                     const core::Pose2& T_map_lidar) {
  const std::vector<MatchedCorner> corners = match_corners(breakpoints, map, T_map_lidar);
  if (corners.size() < 2) return std::nullopt;
  const MatchedCorner& first = corners.front();
  const auto second =
      std::find_if(corners.begin() + 1, corners.end(), [&](const MatchedCorner& other) {
        return (other.on_map - first.on_map).norm() > kMinBaseline_m;
      });
  if (second == corners.end()) return std::nullopt;

  const double theta_rad = core::normalize_angle(core::angle_of(second->on_map - first.on_map) -
                                                 core::angle_of(second->measured - first.measured));
  const core::Pose2 rotation{0, 0, theta_rad};
  const core::Vec2 measured_middle = (first.measured + second->measured) / 2;
  const core::Vec2 position = (first.on_map + second->on_map) / 2 - rotation * measured_middle;
  return core::Pose2{position.x(), position.y(), theta_rad};
}

}  // namespace cornerd::bench
