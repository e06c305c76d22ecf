// SPDX-License-Identifier: MIT
#include "bench/survey_scoring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/map/ray_caster.hpp"

namespace cornerd::bench {
namespace {

using core::Vec2;

constexpr double kCell_m = 0.02;
/// A cell with fewer rays is at the edge of the visible part.
constexpr int kMinRaysPerCell = 10;
constexpr double kMaxRange_m = 6;
constexpr double kMinWall_m = 0.3;
constexpr double kMinFoundShare = 0.95;
/// Largest distance and rotation of a map wall from its true wall.
constexpr double kOnWall_m = 0.03;
const double kMinNormalCosine = std::cos(core::radians(10));
/// Search radius for a corner, and how near to it both walls have to be visible.
constexpr double kCornerSearchRadius_m = 0.10;
constexpr double kMaxDistanceToCorner_m = 0.08;

/// The cells of the true faces that rays hit from the drive's poses.
class VisibleWalls {
 public:
  VisibleWalls(const core::WallMap& map, std::span<const core::Pose2> poses) : map_(map) {
    for (const core::Face& face : map.faces()) {
      rays_.emplace_back(static_cast<std::size_t>(std::ceil(face.length_m / kCell_m)), 0);
    }
    constexpr int kRays = 360;
    core::PolarScan scan;
    scan.begin(core::kTwoPi / kRays);
    for (int i = 0; i < kRays; ++i) scan.append(-core::kPi + (i + 0.5) * core::kTwoPi / kRays, 1);
    core::RayCaster prediction(kMaxRange_m);
    for (const core::Pose2& place : poses) {
      const auto hits = prediction.cast(map, place, scan.points());
      for (std::size_t i = 0; i < hits.size(); ++i) count(place, scan[i], hits[i]);
    }
  }

  std::size_t cells(std::size_t face) const { return rays_[face].size(); }
  bool is_visible(std::size_t face, std::size_t cell) const {
    return rays_[face][cell] >= kMinRaysPerCell;
  }
  Vec2 place_of(std::size_t face, std::size_t cell) const {
    const core::Face& wall = map_.faces()[face];
    return wall.from + (static_cast<double>(cell) + 0.5) * kCell_m * wall.direction;
  }
  /// A visible cell of the face is within kMaxDistanceToCorner_m of the point.
  bool is_visible_near(std::size_t face, const Vec2& point) const {
    for (std::size_t cell = 0; cell < cells(face); ++cell) {
      if (is_visible(face, cell) && (place_of(face, cell) - point).norm() < kMaxDistanceToCorner_m)
        return true;
    }
    return false;
  }

 private:
  void count(const core::Pose2& place, const core::PolarPoint& ray, const core::PredictedHit& hit) {
    if (hit.face == core::PredictedHit::kNone) return;
    const core::Face& face = map_.faces()[hit.face];
    const Vec2 point = place * Vec2(hit.range_m * ray.ray());
    const double cell = face.direction.dot(point - face.from) / kCell_m;
    auto& rays = rays_[hit.face];
    if (cell >= 0 && cell < static_cast<double>(rays.size()))
      ++rays[static_cast<std::size_t>(cell)];
  }

  const core::WallMap& map_;
  std::vector<std::vector<int>> rays_;
};

double distance_to(const core::Face& face, const Vec2& point) {
  const double along_m = std::clamp(face.direction.dot(point - face.from), 0.0, face.length_m);
  return (face.from + along_m * face.direction - point).norm();
}

struct Pair {
  Vec2 truth;
  Vec2 found;
};

/// The nearest map corner of the same kind for each true corner.
std::vector<Pair> pair_corners(std::span<const core::Corner> truth, const core::WallMap& found,
                               const core::Pose2& T_true_map, double reach_m) {
  std::vector<Pair> pairs;
  for (const core::Corner& corner : truth) {
    double least_m = reach_m;
    const core::Corner* best = nullptr;
    for (const core::Corner& other : found.corners()) {
      if (other.is_convex() != corner.is_convex()) continue;
      const double rotated_rad =
          core::angle_between(corner.bisector_rad(), other.bisector_rad() + T_true_map.theta_rad);
      if (std::abs(rotated_rad) > core::radians(25)) continue;
      const double off_m = (T_true_map * other.position - corner.position).norm();
      if (off_m < least_m) {
        least_m = off_m;
        best = &other;
      }
    }
    if (best != nullptr) pairs.push_back({corner.position, best->position});
  }
  return pairs;
}

/// Least squares; `otherwise` for fewer than two pairs.
core::Pose2 align(std::span<const Pair> pairs, const core::Pose2& otherwise) {
  if (pairs.size() < 2) return otherwise;
  Vec2 truth = Vec2::Zero();
  Vec2 found = Vec2::Zero();
  for (const Pair& pair : pairs) {
    truth += pair.truth / static_cast<double>(pairs.size());
    found += pair.found / static_cast<double>(pairs.size());
  }
  double cosine = 0;
  double sine = 0;
  for (const Pair& pair : pairs) {
    const Vec2 a = pair.found - found;
    const Vec2 b = pair.truth - truth;
    cosine += a.dot(b);
    sine += core::cross(a, b);
  }
  const core::Pose2 rotation{0, 0, std::atan2(sine, cosine)};
  const Vec2 shift = truth - rotation * found;
  return {shift.x(), shift.y(), rotation.theta_rad};
}

/// Corners whose faces are both visible up to the corner.
std::vector<core::Corner> visible_corners(const core::WallMap& truth, const VisibleWalls& seen) {
  std::vector<core::Corner> corners;
  for (const core::Corner& corner : truth.corners()) {
    int faces = 0;
    for (std::size_t i = 0; i < truth.faces().size(); ++i) {
      const core::Face& face = truth.faces()[i];
      const double to_end_m =
          std::min((face.from - corner.position).norm(), (face.to - corner.position).norm());
      // Skips the rear side of a wall without thickness.
      if (face.normal.dot(core::unit_vector(corner.bisector_rad())) <= 0) continue;
      if (to_end_m < 1e-6 && seen.is_visible_near(i, corner.position)) ++faces;
    }
    if (faces >= 2) corners.push_back(corner);
  }
  return corners;
}

void score_walls(const core::WallMap& truth, const VisibleWalls& seen, const core::WallMap& found,
                 SurveyScore& score) {
  std::vector<core::Face> faces(found.faces().begin(), found.faces().end());
  for (core::Face& face : faces) {
    face.from = score.T_true_map * face.from;
    face.to = score.T_true_map * face.to;
    face.direction = (face.to - face.from).normalized();
    face.normal = core::rotate_left(face.direction);
  }
  for (std::size_t i = 0; i < truth.faces().size(); ++i) {
    std::size_t cells = 0;
    std::size_t hits = 0;
    for (std::size_t cell = 0; cell < seen.cells(i); ++cell) {
      if (!seen.is_visible(i, cell)) continue;
      ++cells;
      const Vec2 place = seen.place_of(i, cell);
      hits += std::any_of(faces.begin(), faces.end(), [&](const core::Face& face) {
        return face.normal.dot(truth.faces()[i].normal) > kMinNormalCosine &&
               distance_to(face, place) < kOnWall_m;
      });
    }
    score.seen_m += kCell_m * static_cast<double>(cells);
    score.found_m += kCell_m * static_cast<double>(hits);
    if (kCell_m * static_cast<double>(cells) < kMinWall_m) continue;
    ++score.walls_visible;
    if (static_cast<double>(hits) >= kMinFoundShare * static_cast<double>(cells)) {
      ++score.walls_found;
    } else {
      score.missed.push_back((truth.faces()[i].from + truth.faces()[i].to) / 2);
    }
  }
  for (const core::Face& face : faces) {
    for (double along_m = kCell_m / 2; along_m < face.length_m; along_m += kCell_m) {
      const Vec2 place = face.from + along_m * face.direction;
      if (truth.is_solid(place)) continue;
      const bool on_wall =
          std::any_of(truth.faces().begin(), truth.faces().end(),
                      [&](const core::Face& wall) { return distance_to(wall, place) < kOnWall_m; });
      if (on_wall) continue;
      score.invented_m += kCell_m;
      score.invented.push_back(place);
    }
  }
}

}  // namespace

SurveyScore score_survey(const core::WallMap& truth, std::span<const core::Pose2> poses,
                         const core::WallMap& found, const core::Pose2& start) {
  const VisibleWalls seen(truth, poses);
  const std::vector<core::Corner> corners = visible_corners(truth, seen);
  SurveyScore score;
  score.T_true_map = start;
  // Coarse to fine: a map from odometry alone is distorted.
  for (const double reach_m : {0.5, 0.25, kCornerSearchRadius_m, kCornerSearchRadius_m}) {
    score.T_true_map =
        align(pair_corners(corners, found, score.T_true_map, reach_m), score.T_true_map);
  }
  const auto pairs = pair_corners(corners, found, score.T_true_map, kCornerSearchRadius_m);
  score.corners_visible = corners.size();
  score.corners_found = pairs.size();
  for (const Pair& pair : pairs) {
    score.corner_errors_m.push_back((score.T_true_map * pair.found - pair.truth).norm());
  }
  std::sort(score.corner_errors_m.begin(), score.corner_errors_m.end());
  score_walls(truth, seen, found, score);
  return score;
}

}  // namespace cornerd::bench
