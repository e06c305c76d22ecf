// SPDX-License-Identifier: MIT
#include "replay/simulator/corner_truth.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::replay {
namespace {

/// Far above the noise of any A1 indoors, far below the distance from one wall to the next: what
/// differs more did not come from the predicted wall.
constexpr double kAgreement_m = 0.05;
constexpr double kAgreementShare = 0.05;
/// The map's corners lie on their faces to a few rounding errors.
constexpr double kOnFace_m = 1e-5;

}  // namespace

CornerTruth::CornerTruth(const core::WallMap& map, double max_range_m)
    : map_(map), prediction_(max_range_m) {
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
    // The free space is on the left of a face: the left face of a corner leaves it, the right one
    // comes to it.
    if ((left ? 1 : -1) * face.direction.dot(away) < 1 - 1e-9) continue;
    if (std::abs(face.normal.dot(position) - face.offset_m) > kOnFace_m) continue;
    const double along_m = face.direction.dot(position - face.from);
    const double rest_m = left ? face.length_m - along_m : along_m;
    if (along_m < -kOnFace_m || along_m > face.length_m + kOnFace_m || rest_m < kOnFace_m) continue;
    return left ? Side{i, along_m, face.length_m} : Side{i, 0, along_m};
  }
  return {};
}

bool CornerTruth::is_in_sight(const core::Vec2& origin, const core::Vec2& corner) const {
  const core::Vec2 way = corner - origin;
  return map_.range_along(origin, std::atan2(way.y(), way.x()), way.norm() - kOnFace_m) == 0;
}

std::uint32_t CornerTruth::returns_of(const Side& side) const {
  return static_cast<std::uint32_t>(std::count_if(met_.begin(), met_.end(), [&](const Met& met) {
    return met.face == side.face && met.along_m >= side.from_m - kOnFace_m &&
           met.along_m <= side.to_m + kOnFace_m;
  }));
}

void CornerTruth::look(const core::Pose2& T_map_lidar, std::span<const core::PolarPoint> points) {
  met_.clear();
  const auto hits = prediction_.cast(map_, T_map_lidar, points);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const core::PredictedHit& hit = hits[i];
    if (hit.face == core::PredictedHit::kNone) continue;
    const double off_m = std::abs(points[i].range_m - hit.range_m);
    if (off_m > kAgreement_m + kAgreementShare * hit.range_m) continue;
    const core::Face& face = map_.faces()[hit.face];
    const core::Vec2 place =
        T_map_lidar * core::Vec2(hit.range_m * points[i].ray_x, hit.range_m * points[i].ray_y);
    met_.push_back({hit.face, face.direction.dot(place - face.from), hit.range_m, i});
  }

  corners_.clear();
  const core::Pose2 T_lidar_map = T_map_lidar.inverse();
  for (std::uint32_t i = 0; i < sides_.size(); ++i) {
    SeenCorner seen;
    seen.corner = i;
    seen.left_returns = returns_of(sides_[i].left);
    seen.right_returns = returns_of(sides_[i].right);
    if (seen.left_returns == 0 && seen.right_returns == 0) continue;
    const core::Vec2& position = map_.corners()[i].position;
    seen.position = T_lidar_map * position;
    const std::uint32_t fewer = std::min(seen.left_returns, seen.right_returns);
    const bool in_sight = is_in_sight(T_map_lidar.translation(), position);
    if (!in_sight && fewer == 0) continue;
    seen.view = !in_sight                  ? CornerView::kHidden
                : fewer >= kSupportReturns ? CornerView::kSupported
                : fewer > 0                ? CornerView::kVisible
                                           : CornerView::kOneSided;
    corners_.push_back(seen);
  }
  find_shadow_ends(points);
}

bool CornerTruth::are_neighbours(std::uint32_t face, std::uint32_t other) const {
  return std::any_of(sides_.begin(), sides_.end(), [&](const Sides& sides) {
    return (sides.left.face == face && sides.right.face == other) ||
           (sides.left.face == other && sides.right.face == face);
  });
}

void CornerTruth::find_shadow_ends(std::span<const core::PolarPoint> points) {
  shadow_ends_.clear();
  for (std::size_t i = 0; i < met_.size(); ++i) {
    const Met& right = met_[i];
    const Met& left = met_[(i + 1) % met_.size()];
    if (right.face == left.face || are_neighbours(right.face, left.face)) continue;
    const Met& farther = right.range_m > left.range_m ? right : left;
    const core::PolarPoint& ray = points[farther.point];
    shadow_ends_.emplace_back(farther.range_m * ray.ray_x, farther.range_m * ray.ray_y);
  }
}

}  // namespace cornerd::replay
