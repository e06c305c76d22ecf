// SPDX-License-Identifier: MIT
// Which face each ray meets, and what becomes of it there.
#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"
#include "core/recognition/beam_model.hpp"

namespace cornerd::core {
namespace {

/// Share of the rays that end on the mapped wall: a furnished room.
constexpr double kWallShare = 0.7;
/// Density of a range that says nothing of the place: uniform over a room, 1/m.
constexpr double kAnyDensity = 0.25;
constexpr double kGateSigmas = 3;
/// Roughness of real surfaces, and what the noise model leaves out, as a standard deviation.
constexpr double kSurface_m = 0.003;
constexpr double kNoiseVarianceScale = 1.5;
constexpr double kMinSine = 0.05;
/// Beyond all walls.
constexpr double kBeyondAll_m = 1e3;
/// Neighbouring rays whose wall a ray at an edge may meet, and where two walls are two.
constexpr double kEdge_m = 0.06;
constexpr double kMaxEdgeRays = 8;
constexpr double kMaxEdge_rad = radians(3.6);  ///< of a dense lidar
constexpr double kStep_m = 0.1;

/// Where walls are taken to be exact: the share of the rays near one, and density of a ray that is
/// stopped before, over kAnyDensity.
constexpr double kNearShare = 0.15;
constexpr double kShortRatio = 0.2;

/// Half of the rays on walls, as the rest may be people and chairs, and hardly any through one. The
/// two walls of one corner fit any other corner, so that of few rays more than half.
constexpr std::size_t kMinSurplus = 30;
constexpr double kMinHitShare = 0.25;
constexpr double kMaxViolations = 0.08;
/// A place with a lower share of hits than outliers and mixed pixels explain, or with few hits, may
/// be the wrong one of several: rooms of one building share walls.
constexpr double kCertainHitShare = 0.97;
constexpr double kCertainHitShareExpected = 0.9;
constexpr std::size_t kCertainHits = 100;

}  // namespace

bool BeamCounts::explains_scan() const {
  const std::size_t on_walls = hits + near_hits;
  return on_walls >= rays - on_walls + kMinSurplus && hit_share() >= kMinHitShare &&
         violation_share() <= kMaxViolations;
}

bool BeamCounts::is_conclusive(bool expected) const {
  return hits >= kCertainHits &&
         hit_share() >= (expected ? kCertainHitShareExpected : kCertainHitShare);
}

void BeamModel::meet(std::span<const PolarPoint> points, std::span<const PredictedHit> hits,
                     const Pose2& T_map_lidar, double spacing_rad, double noise_scale) {
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  const auto sine_of = [&](const PolarPoint& point, std::uint32_t face) {
    const Vec2& normal = map_.faces()[face].normal;
    return std::max(kMinSine, std::abs(normal.x() * (c * point.ray_x - s * point.ray_y) +
                                       normal.y() * (s * point.ray_x + c * point.ray_y)));
  };
  const double most_edge_rays = std::max(kMaxEdgeRays, kMaxEdge_rad / spacing_rad);
  points_ = points;
  spacing_rad_ = spacing_rad;
  rays_.resize(points.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const PolarPoint& point = points[static_cast<std::size_t>(i)];
    const PredictedHit& met = hits[static_cast<std::size_t>(i)];
    Ray& ray = rays_[static_cast<std::size_t>(i)];
    ray.face = ray.predicted = met.face;
    const bool none = met.face == PredictedHit::kNone;
    double sine = none ? 1 : std::max<double>(kMinSine, met.sine);
    ray.across_m = none ? kBeyondAll_m : (point.range_m - met.range_m) * sine;
    const double near_m = none ? point.range_m : std::min(met.range_m, point.range_m);
    if (std::abs(ray.across_m) > kEdge_m) {
      // At an edge it may be the neighbours' face that is met.
      const auto reach =
          std::min(count, static_cast<std::ptrdiff_t>(std::clamp<double>(
                              kEdge_m / (near_m * spacing_rad), kEdgeRays, most_edge_rays)));
      for (std::ptrdiff_t step = -reach; step <= reach; ++step) {
        const PredictedHit& other = hits[static_cast<std::size_t>((i + step + count) % count)];
        if (other.face == PredictedHit::kNone || other.face == met.face ||
            (!none && std::abs(other.range_m - met.range_m) < kStep_m)) {
          continue;
        }
        const double other_sine = sine_of(point, other.face);
        const double across_m = (point.range_m - other.range_m) * other_sine;
        if (std::abs(across_m) >= std::abs(ray.across_m)) continue;
        ray.face = other.face;
        ray.across_m = across_m;
        sine = other_sine;
      }
    }
    ray.variance_m2 = noise_.variance_across_m2(point.range_m, sine) * noise_scale * noise_scale *
                          kNoiseVarianceScale +
                      kSurface_m * kSurface_m;
    ray.log_peak =
        std::log(kWallShare * sine / (kAnyDensity * std::sqrt(kTwoPi * ray.variance_m2)));
  }
}

BeamModel::Outcome BeamModel::outcome_of(const Ray& ray, double map_sigma_m) const {
  if (ray.face == PredictedHit::kNone) return Outcome::kBeyond;
  const double sigma_m = std::max(map_sigma_m, map_.faces()[ray.face].sigma_m);
  if (squared(ray.across_m) < squared(kGateSigmas) * (ray.variance_m2 + squared(sigma_m))) {
    return Outcome::kHit;
  }
  return ray.across_m < 0 ? Outcome::kShort : Outcome::kViolation;
}

double BeamModel::log_density(const Ray& ray) const {
  const double log_other = std::log(kOutlierRatio);
  const double square_m2 = squared(ray.across_m);
  const double hit = ray.log_peak - square_m2 / (2 * ray.variance_m2);
  // Nearer than this a hit is likelier than something near, whatever their variances are.
  if (square_m2 < 2 * std::log(kWallShare / kNearShare) * ray.variance_m2) return hit;
  const double near_m2 = ray.variance_m2 + squared(kNearSigma_m);
  const double near = ray.log_peak + std::log(kNearShare / kWallShare) +
                      std::log(ray.variance_m2 / near_m2) / 2 - square_m2 / (2 * near_m2);
  return std::max({hit, near, log_other});
}

BeamCounts BeamModel::counts() const {
  BeamCounts result;
  result.rays = rays_.size();
  for (const Ray& ray : rays_) {
    const Outcome outcome = outcome_of(ray, kMapSigmas_m.front());
    if (outcome == Outcome::kHit) {
      ++result.hits;
      result.log_likelihood += log_density(ray);
    } else if (outcome_of(ray, kNearSigma_m) == Outcome::kHit) {
      ++result.near_hits;
      result.log_likelihood += log_density(ray);
    } else if (outcome == Outcome::kViolation) {
      ++result.free_space_violations;
      result.log_likelihood += std::log(kOutlierRatio);
    } else {
      ++result.shorts;
      result.log_likelihood += std::log(outcome == Outcome::kShort ? kShortRatio : kOutlierRatio);
    }
  }
  return result;
}

void BeamModel::classify(double map_sigma_m, double near_sigma_m, BeamStatistics& result) {
  result.rays = rays_.size();
  result.map_sigma_m = map_sigma_m;
  for (Ray& ray : rays_) {
    ray.outcome = outcome_of(ray, map_sigma_m);
    const bool is_near = ray.outcome != Outcome::kHit && near_sigma_m > map_sigma_m &&
                         outcome_of(ray, near_sigma_m) == Outcome::kHit;
    if (is_near) ray.outcome = Outcome::kNear;
    result.hits += ray.outcome == Outcome::kHit ? 1 : 0;
    result.shorts += ray.outcome == Outcome::kShort ? 1 : 0;
    result.free_space_violations += ray.outcome == Outcome::kViolation ? 1 : 0;
  }
}

}  // namespace cornerd::core
