// SPDX-License-Identifier: MIT
#include "core/map/ray_caster.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Larger than any range error and any pose error of a hypothesis.
constexpr double kBeyond_m = 1;
/// Faces that a room shows are some ten.
constexpr std::size_t kMaxVisible = 1024;

/// The ray's bearing is below that of a direction, without an arctangent. By its bearing a ray is
/// left or right, as rays are in the order of bearings: that of pi as a float is beyond pi.
bool is_before(const PolarPoint& point, const Vec2& direction) {
  const bool is_left = point.bearing_rad >= 0;
  const bool to_the_left = direction.y() >= 0;
  return is_left == to_the_left ? point.ray_x * direction.y() > point.ray_y * direction.x()
                                : to_the_left;
}

/// First ray at or after a direction.
std::size_t first_at(std::span<const PolarPoint> points, const Vec2& direction) {
  const auto found =
      std::partition_point(points.begin(), points.end(),
                           [&](const PolarPoint& point) { return is_before(point, direction); });
  return static_cast<std::size_t>(found - points.begin());
}

}  // namespace

RayCaster::RayCaster(double max_range_m) : max_range_m_(max_range_m) {
  hits_.reserve(kMaxSamplesPerScan);
  visible_.reserve(kMaxVisible);
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

RayCaster::Axes::Axes(const Pose2& T_map_lidar)
    : c(std::cos(T_map_lidar.theta_rad)), s(std::sin(T_map_lidar.theta_rad)) {}

void RayCaster::begin(std::size_t points, double max_range_m) {
  hits_.assign(points, {max_range_m, PredictedHit::kNone});
  last_max_range_m_ = max_range_m;
}

void RayCaster::meet(std::uint32_t face, const WallMap& map, const VisibleFace& visible,
                     const Axes& axes, std::span<const PolarPoint> points) {
  const Vec2 from = axes.to_lidar(visible.from);
  const Vec2 to = axes.to_lidar(visible.to);
  const Vec2 normal = axes.to_lidar(map.faces()[face].normal);
  const auto cover = [&](std::size_t i) {
    const double approach = -(normal.x() * points[i].ray_x + normal.y() * points[i].ray_y);
    PredictedHit& hit = hits_[i];
    // height / approach < range, without a division where the face is not the nearest.
    if (approach <= 0 || visible.height_m > hit.range_m * approach) return;
    hit = {visible.height_m / approach, face, static_cast<float>(approach)};
  };
  // Seen from its free side a face runs counter-clockwise from `from` to `to`, over less than pi;
  // seen along itself it hides nothing.
  if (!(cross(from, to) > 0)) return;
  const std::size_t first = first_at(points, from);
  const std::size_t beyond = first_at(points, to);
  const bool crosses_seam = from.y() >= 0 && to.y() < 0;
  for (std::size_t i = first; i < (crosses_seam ? points.size() : beyond); ++i) cover(i);
  for (std::size_t i = 0; crosses_seam && i < beyond; ++i) cover(i);
}

std::span<const PredictedHit> RayCaster::end() {
  for (PredictedHit& hit : hits_) {
    if (hit.face == PredictedHit::kNone) hit.range_m = 0;
  }
  return hits_;
}

std::span<const PredictedHit> RayCaster::cast(const WallMap& map, const Pose2& T_map_lidar,
                                              std::span<const PolarPoint> points,
                                              double max_range_m) {
  const Axes axes(T_map_lidar);
  begin(points.size(), max_range_m);
  visible_.clear();
  visible_faces_.find(map, T_map_lidar.translation(), max_range_m,
                      [&](std::uint32_t face, const VisibleFace& visible) {
                        if (visible_.size() < kMaxVisible) visible_.push_back(face);
                        meet(face, map, visible, axes, points);
                      });
  return end();
}

std::span<const PredictedHit> RayCaster::cast_again(const WallMap& map, const Pose2& T_map_lidar,
                                                    std::span<const PolarPoint> points) {
  if (visible_.size() == kMaxVisible) return cast(map, T_map_lidar, points, last_max_range_m_);
  const Axes axes(T_map_lidar);
  begin(points.size(), last_max_range_m_);
  const Vec2 origin = T_map_lidar.translation();
  for (const std::uint32_t index : visible_) {
    const Face& face = map.faces()[index];
    const double height_m = face.normal.dot(origin) - face.offset_m;
    if (height_m <= 0) continue;
    meet(index, map, {face.from - origin, face.to - origin, height_m}, axes, points);
  }
  return end();
}

}  // namespace cornerd::core
