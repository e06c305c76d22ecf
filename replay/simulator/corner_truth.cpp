// SPDX-License-Identifier: MIT
#include "replay/simulator/corner_truth.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::replay {
namespace {

/// Far above an A1's noise indoors, far below the distance between walls.
constexpr double kMaxResidual_m = 0.05;
constexpr double kMaxResidualShare = 0.05;
/// Rounding errors of corners on their faces.
constexpr double kOnFace_m = 1e-5;

}  // namespace

CornerTruth::CornerTruth(const core::WallMap& map, double max_range_m)
    : map_(map), ray_caster_(max_range_m) {
  for (const core::Corner& corner : map.corners()) {
    sides_.push_back({side_of(corner.position, corner.left_face_rad, true),
                      side_of(corner.position, corner.right_face_rad, false)});
  }
}

CornerTruth::Side CornerTruth::side_of(const core::Vec2& position, double direction_rad,
                                       bool left) const {
  const core::Vec2 away = core::unit_vector(direction_rad);
  const auto faces = map_.faces();
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const core::Face& face = faces[i];
    // Free space is on a face's left: the left face of a corner begins there, the right one ends.
    if ((left ? 1 : -1) * face.direction.dot(away) < 1 - 1e-9) continue;
    if (std::abs(face.normal.dot(position) - face.offset_m) > kOnFace_m) continue;
    const double along_m = face.direction.dot(position - face.from);
    const double rest_m = left ? face.length_m - along_m : along_m;
    if (along_m < -kOnFace_m || along_m > face.length_m + kOnFace_m || rest_m < kOnFace_m) continue;
    return left ? Side{i, along_m, face.length_m} : Side{i, 0, along_m};
  }
  return {};
}

bool CornerTruth::has_line_of_sight(const core::Vec2& origin, const core::Vec2& corner) const {
  const core::Vec2 way = corner - origin;
  return map_.range_along(origin, std::atan2(way.y(), way.x()), way.norm() - kOnFace_m) == 0;
}

std::uint32_t CornerTruth::returns_of(const Side& side) const {
  return static_cast<std::uint32_t>(
      std::count_if(hits_.begin(), hits_.end(), [&](const WallHit& hit) {
        return hit.face == side.face && hit.along_m >= side.from_m - kOnFace_m &&
               hit.along_m <= side.to_m + kOnFace_m;
      }));
}

void CornerTruth::observe(const core::Pose2& T_map_lidar,
                          std::span<const core::PolarPoint> points) {
  hits_.clear();
  const auto hits = ray_caster_.cast(map_, T_map_lidar, points);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const core::PredictedHit& hit = hits[i];
    if (hit.face == core::PredictedHit::kNone) continue;
    const double off_m = std::abs(points[i].range_m - hit.range_m);
    if (off_m > kMaxResidual_m + kMaxResidualShare * hit.range_m) continue;
    const core::Face& face = map_.faces()[hit.face];
    const core::Vec2 place =
        T_map_lidar * core::Vec2(hit.range_m * points[i].ray_x, hit.range_m * points[i].ray_y);
    hits_.push_back({hit.face, face.direction.dot(place - face.from), hit.range_m, i});
  }

  corners_.clear();
  const core::Pose2 T_lidar_map = T_map_lidar.inverse();
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    CornerObservation observation;
    observation.corner = i;
    observation.left_returns = returns_of(sides_[i].left);
    observation.right_returns = returns_of(sides_[i].right);
    if (observation.left_returns == 0 && observation.right_returns == 0) continue;
    const core::Vec2& position = map_.corners()[i].position;
    observation.position = T_lidar_map * position;
    const std::uint32_t fewer = std::min(observation.left_returns, observation.right_returns);
    const bool is_visible = has_line_of_sight(T_map_lidar.translation(), position);
    if (!is_visible && fewer == 0) continue;
    observation.view = !is_visible                ? CornerView::kHidden
                       : fewer >= kSupportReturns ? CornerView::kSupported
                       : fewer > 0                ? CornerView::kVisible
                                                  : CornerView::kOneSided;
    corners_.push_back(observation);
  }
  find_occlusion_edges(points);
}

bool CornerTruth::are_neighbours(std::uint32_t face, std::uint32_t other) const {
  return std::any_of(sides_.begin(), sides_.end(), [&](const Sides& sides) {
    return (sides.left.face == face && sides.right.face == other) ||
           (sides.left.face == other && sides.right.face == face);
  });
}

void CornerTruth::find_occlusion_edges(std::span<const core::PolarPoint> points) {
  occlusion_edges_.clear();
  for (std::size_t i = 0; i < hits_.size(); ++i) {
    const WallHit& right = hits_[i];
    const WallHit& left = hits_[(i + 1) % hits_.size()];
    if (right.face == left.face || are_neighbours(right.face, left.face)) continue;
    const WallHit& farther = right.range_m > left.range_m ? right : left;
    const core::PolarPoint& ray = points[farther.point];
    occlusion_edges_.emplace_back(farther.range_m * ray.ray_x, farther.range_m * ray.ray_y);
  }
}

}  // namespace cornerd::replay
