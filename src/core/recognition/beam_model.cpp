// SPDX-License-Identifier: MIT
#include "core/recognition/beam_model.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

/// Rays are counted as if there were 400 a revolution: more are not more independent.
constexpr double kNominalSpacing_rad = kTwoPi / 400;
/// What n hits on one face are worth together: kWorth log(1 + n / kWorthHalf) of them. A face gives
/// an offset and a direction, and their precision grows with the logarithm.
constexpr double kWorth = 0.33;
constexpr double kWorthHalf = 0.02;
/// An unmapped object costs this much, and more the wider it is (nats, nats per metre).
constexpr double kObject = 1;
constexpr double kObjectPerMetre = 12;
constexpr double kObjectStep_m = 0.1;
/// Fewer nominal rays on a face or an object are the part of one.
constexpr double kWholeRays = 3;
/// A face within so much of the view is seen where more than this share of its rays hit.
constexpr double kInView_rad = radians(4);
constexpr double kSeenShare = 0.15;
/// A wall that is not there (nats), and each nominal ray through it. Faces shorter than kWall_m are
/// the less permanent the shorter they are: furniture.
constexpr double kMissingWall = 10;
constexpr double kMissingWallPerRay = 3;
constexpr double kWall_m = 0.3;
/// Each of the rays that end on a wall's edge and miss it: kEdgeRays in a row, or all of a dense
/// lidar's within one nominal ray.
constexpr double kEdgeRay = 1;
constexpr double kEdgeNominalRays = 1;
/// A face that fits worse than this has something before it.
constexpr double kWorstFace = -3;
/// A map is the less likely the less exact it is.
constexpr double kPerMapSigma = 1;

}  // namespace

BeamModel::BeamModel(const WallMap& map, const SensorNoise& noise)
    : map_(map),
      noise_(noise),
      trust_(std::min(1.0, FloorPlan::kMeasuredSigma_m / map.plan().sigma_m)),
      faces_(map.faces().size()) {
  rays_.reserve(kMaxSamplesPerScan);
  met_.reserve(faces_.size());
}

BeamModel::FaceSums& BeamModel::sums_of(std::uint32_t face) {
  FaceSums& sums = faces_[face];
  if (sums.evaluation != evaluation_) {
    sums = {};
    sums.evaluation = evaluation_;
    met_.push_back(face);
  }
  return sums;
}

void BeamModel::add_view(BeamStatistics& result) const {
  for (const std::uint32_t index : met_) {
    const FaceSums& face = faces_[index];
    result.predicted += face.predicted;
    result.predicted_hits += face.predicted_hits;
    result.unseen_faces += face.predicted * spacing_rad_ > kInView_rad &&
                                   face.predicted_hits < kSeenShare * face.predicted
                               ? 1
                               : 0;
  }
}

void BeamModel::add_faces(double map_sigma_m, BeamStatistics& result) {
  const auto variance_m2 = [&](std::uint32_t face) {
    return squared(std::max(map_sigma_m, map_.faces()[face].sigma_m));
  };
  ++evaluation_;
  met_.clear();
  std::uint32_t last = PredictedHit::kNone;  // faces come in runs of rays
  FaceSums* predicted = nullptr;
  for (const Ray& ray : rays_) {
    const bool hits = ray.outcome == Outcome::kHit;
    if (ray.predicted != last && ray.predicted != PredictedHit::kNone) {
      predicted = &sums_of(ray.predicted);
    }
    if (ray.predicted != PredictedHit::kNone && ray.outcome != Outcome::kNear) {
      predicted->predicted += 1;
      predicted->predicted_hits += hits && ray.face == ray.predicted ? 1 : 0;
    }
    last = ray.predicted;
    if (!hits) continue;
    FaceSums& face = ray.face == ray.predicted ? *predicted : sums_of(ray.face);
    face.rays += 1;
    face.information += 1 / ray.variance_m2;
    face.gradient += ray.across_m / ray.variance_m2;
  }
  const auto worth = [&](double rays) {
    const double nominal = rays * spacing_rad_ / kNominalSpacing_rad;
    return std::min(1.0, kWorth * std::log1p(nominal / kWorthHalf) / rays);
  };
  for (const std::uint32_t index : met_) {
    FaceSums& face = faces_[index];
    if (face.rays == 0) continue;
    const double share = worth(face.rays);
    face.offset_m = share * face.gradient / (share * face.information + 1 / variance_m2(index));
  }
  for (const Ray& ray : rays_) {
    if (ray.outcome != Outcome::kHit) continue;
    FaceSums& face = faces_[ray.face];
    const double residual_m = ray.across_m - face.offset_m;
    face.log_density += std::max(ray.log_peak - residual_m * residual_m / (2 * ray.variance_m2),
                                 std::log(kOutlierRatio));
  }
  for (const std::uint32_t index : met_) {
    const FaceSums& face = faces_[index];
    if (face.rays == 0) continue;
    const double share = worth(face.rays);
    result.faces += std::min(1.0, face.rays * spacing_rad_ / kNominalSpacing_rad / kWholeRays);
    result.faces_log_ratio +=
        std::max(kWorstFace, share * face.log_density -
                                 std::log1p(variance_m2(index) * share * face.information) / 2 -
                                 face.offset_m * face.offset_m / (2 * variance_m2(index)));
  }
  result.log_likelihood += result.faces_log_ratio;
  add_view(result);
}

void BeamModel::add_runs(BeamStatistics& result) const {
  const auto continues = [&](std::size_t i) {
    const Ray& a = rays_[i - 1];
    const Ray& b = rays_[i];
    if (a.outcome != b.outcome) return false;
    if (a.outcome == Outcome::kViolation) return a.face == b.face;
    return a.outcome != Outcome::kShort ||
           std::abs(points_[i].range_m - points_[i - 1].range_m) < kObjectStep_m;
  };
  for (std::size_t begin = 0, end = 0; begin < rays_.size(); begin = end) {
    for (end = begin + 1; end < rays_.size() && continues(end);) ++end;
    const std::size_t count = end - begin;
    const auto rays = static_cast<double>(count);
    switch (rays_[begin].outcome) {
      case Outcome::kHit:
      case Outcome::kNear:
        break;
      case Outcome::kShort: {
        const double width_m = (points_[end - 1].position() - points_[begin].position()).norm() +
                               spacing_rad_ * points_[begin].range_m;
        const double object = std::min(1.0, rays / kWholeRays);
        result.obstacles_m += width_m;
        result.log_likelihood -= kObject * object + trust_ * kObjectPerMetre * width_m;
        break;
      }
      case Outcome::kViolation: {
        const double permanent = std::min(1.0, map_.faces()[rays_[begin].face].length_m / kWall_m);
        const double nominal = rays * spacing_rad_ / kNominalSpacing_rad;
        const bool is_edge = count <= kEdgeRays || nominal <= kEdgeNominalRays;
        if (!is_edge) {
          result.missing_walls += permanent;
          result.rays_through += permanent * nominal;
        }
        result.log_likelihood -=
            trust_ * permanent *
            (is_edge ? kEdgeRay * std::min(rays, static_cast<double>(kEdgeRays))
                     : kMissingWall + kMissingWallPerRay * nominal);
        break;
      }
      case Outcome::kBeyond: {
        result.log_likelihood -= std::min(2.0, std::sqrt(rays));
        break;
      }
    }
  }
}

BeamStatistics BeamModel::by_map_sigma(double map_sigma_m, double near_sigma_m) {
  BeamStatistics result;
  classify(map_sigma_m, near_sigma_m, result);
  add_faces(map_sigma_m, result);
  add_runs(result);
  result.log_likelihood -= kPerMapSigma * std::log(map_sigma_m / kMapSigmas_m.front());
  return result;
}

BeamStatistics BeamModel::statistics(double max_map_sigma_m) {
  BeamStatistics best = by_map_sigma(kMapSigmas_m.front(), kMapSigmas_m.front());
  for (const double map_sigma_m : std::span(kMapSigmas_m).subspan(1)) {
    if (map_sigma_m > max_map_sigma_m) break;
    const BeamStatistics other = by_map_sigma(map_sigma_m, map_sigma_m);
    if (other.log_likelihood > best.log_likelihood) best = other;
  }
  return best;
}

BeamStatistics BeamModel::statistics_if_exact() {
  return by_map_sigma(kMapSigmas_m.front(), kNearSigma_m);
}

}  // namespace cornerd::core
