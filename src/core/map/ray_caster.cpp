// SPDX-License-Identifier: MIT
#include "core/map/ray_caster.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Larger than any range error and any pose error of a hypothesis.
constexpr double kBeyond_m = 1;

/// First ray at or after the bearing.
std::size_t first_at(std::span<const PolarPoint> points, double bearing_rad) {
  const auto found = std::partition_point(
      points.begin(), points.end(),
      [&](const PolarPoint& point) { return point.bearing_rad < bearing_rad; });
  return static_cast<std::size_t>(found - points.begin());
}

}  // namespace

RayCaster::RayCaster(double max_range_m) : max_range_m_(max_range_m) {
  hits_.reserve(kMaxSamplesPerScan);
}

void RayCaster::cover(std::uint32_t face, const Vec2& normal_lidar, double height_m,
                      std::size_t begin, std::size_t end, std::span<const PolarPoint> points) {
  for (std::size_t i = begin; i < end; ++i) {
    const double approach =
        -(normal_lidar.x() * points[i].ray_x + normal_lidar.y() * points[i].ray_y);
    PredictedHit& hit = hits_[i];
    // height / approach < range, without a division where the face is not the nearest.
    if (approach <= 0 || height_m > hit.range_m * approach) continue;
    hit.range_m = height_m / approach;
    hit.face = face;
  }
}

std::span<const PredictedHit> RayCaster::cast(const WallMap& map, const Pose2& T_map_lidar,
                                              std::span<const PolarPoint> points) {
  return cast(map, T_map_lidar, points, max_range_m_);
}

std::span<const PredictedHit> RayCaster::cast_near(const WallMap& map, const Pose2& T_map_lidar,
                                                   std::span<const PolarPoint> points) {
  double farthest_m = 0;
  for (const PolarPoint& point : points) farthest_m = std::max(farthest_m, point.range_m);
  return cast(map, T_map_lidar, points, std::min(max_range_m_, farthest_m + kBeyond_m));
}

std::span<const PredictedHit> RayCaster::cast(const WallMap& map, const Pose2& T_map_lidar,
                                              std::span<const PolarPoint> points,
                                              double max_range_m) {
  hits_.assign(points.size(), {max_range_m, PredictedHit::kNone});
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  const Vec2 origin = T_map_lidar.translation();
  const auto to_lidar = [&](const Vec2& v) {
    return Vec2(c * v.x() + s * v.y(), -s * v.x() + c * v.y());
  };
  visible_faces_.find(map, origin, max_range_m, [&](std::uint32_t i, const VisibleFace& visible) {
    const Vec2 from = to_lidar(visible.from);
    const Vec2 to = to_lidar(visible.to);
    const Vec2 normal = to_lidar(map.faces()[i].normal);
    // Seen from its free side a face runs counter-clockwise from `from` to `to`, over less than pi.
    // A falling bearing means that it crosses the seam.
    const double from_rad = std::atan2(from.y(), from.x());
    const double to_rad = std::atan2(to.y(), to.x());
    const std::size_t begin = first_at(points, from_rad);
    const std::size_t end = first_at(points, to_rad);
    if (from_rad <= to_rad) {
      cover(i, normal, visible.height_m, begin, end, points);
    } else {
      cover(i, normal, visible.height_m, begin, points.size(), points);
      cover(i, normal, visible.height_m, 0, end, points);
    }
  });
  for (PredictedHit& hit : hits_) {
    if (hit.face == PredictedHit::kNone) hit.range_m = 0;
  }
  return hits_;
}

}  // namespace cornerd::core
