// SPDX-License-Identifier: MIT
#include "core/recognition/place_fitter.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

constexpr std::size_t kFewRays = 90;
/// A ray on the wall that is predicted, roughly (m).
constexpr double kRoughHit_m = 0.12;
/// Refinement that leads farther away has left its place.
constexpr double kMaxMove_m = 0.5;
constexpr double kMaxMove_rad = 0.3;
/// A pose that is less certain than this beyond the map is not named: a single wall, a bare
/// corridor. It is a rival to those that are. Where only a few rays tell the place along a
/// corridor, a prior as sure as kSurePrior_m has to lead there.
constexpr double kMaxSigma_m = 0.1;
constexpr double kSurePrior_m = 0.05;
/// Residuals are the walls' offsets up to so many of their standard deviations; greater ones are of
/// a motion.
constexpr double kMaxRmseSigmas = 1.3;
constexpr double kMaxRmseSigmasStated = 2;
/// Share of the rays on walls, beyond which what does not fit an exact map is a motion or
/// furniture; and of those that reach walls, where nothing is known of the map.
constexpr double kExactMapShare = 0.8;
constexpr double kExactShare = 0.95;

}  // namespace

PlaceFitter::PlaceFitter(const WallMap& map, const LocalizerConfig& config)
    : map_(map),
      ray_caster_(config.max_range_m),
      refinement_(config.max_range_m, config.noise),
      beam_model_(map, config.noise) {
  few_.reserve(2 * kFewRays);
}

void PlaceFitter::begin(const PolarScan& scan, const ScanPrior& known) {
  points_ = scan.points();
  spacing_rad_ = scan.spacing_rad();
  known_ = known;
  T_map_met_.reset();
  take_few(points_, kFewRays, few_);
}

double PlaceFitter::rough_score(const Pose2& T_map_lidar) {
  const auto hits = ray_caster_.cast_near(map_, T_map_lidar, few_);
  double score = 0;
  for (std::size_t i = 0; i < few_.size(); ++i) {
    if (hits[i].face == PredictedHit::kNone) {
      score -= 0.5;
      continue;
    }
    const double across_m = (few_[i].range_m - hits[i].range_m) * hits[i].sine;
    if (std::abs(across_m) < kRoughHit_m) {
      score += 1;
    } else if (across_m > 0) {
      score -= 1;
    }
  }
  return score / static_cast<double>(std::max<std::size_t>(1, few_.size()));
}

std::optional<Pose2> PlaceFitter::roughly(const Pose2& T_map_lidar, double search_radius_m,
                                          double map_sigma_m) {
  const RefinedPose refined = refinement_.refine_roughly(map_, T_map_lidar, search_radius_m, few_,
                                                         known_.noise_scale, map_sigma_m);
  if (!refined.valid || !same_pose(refined.T_map_lidar, T_map_lidar, kMaxMove_m, kMaxMove_rad)) {
    return std::nullopt;
  }
  return refined.T_map_lidar;
}

BeamStatistics PlaceFitter::statistics_of_few(const Pose2& T_map_lidar) {
  const double spacing_rad = spacing_rad_ * static_cast<double>(points_.size()) /
                             static_cast<double>(std::max<std::size_t>(1, few_.size()));
  T_map_met_.reset();
  beam_model_.meet(few_, ray_caster_.cast(map_, T_map_lidar, few_), T_map_lidar, spacing_rad,
                   known_.noise_scale);
  return beam_model_.statistics(known_.max_map_sigma_m);
}

void PlaceFitter::meet(const Pose2& T_map_lidar) {
  if (T_map_met_ == T_map_lidar) return;
  beam_model_.meet(points_, ray_caster_.cast(map_, T_map_lidar, points_), T_map_lidar, spacing_rad_,
                   known_.noise_scale);
  T_map_met_ = T_map_lidar;
}

BeamStatistics PlaceFitter::statistics(const VerifiedHypothesis& place) {
  meet(place.refined.T_map_lidar);
  const bool is_followed =
      !may_be_off() && known_.prior &&
      same_pose(known_.prior->T_map_lidar, place.refined.T_map_lidar, kJump_m, kJump_rad);
  if (place.is_exact && is_followed) return beam_model_.statistics_if_exact();
  return beam_model_.statistics(place.is_exact ? BeamModel::kMapSigmas_m.front()
                                               : known_.max_map_sigma_m);
}

VerifiedHypothesis PlaceFitter::exactly(const Pose2& T_map_lidar, double search_radius_m,
                                        std::span<const PolarPoint> first) {
  VerifiedHypothesis fit;
  const PosePrior prior = PosePrior::near_to(T_map_lidar);
  fit.refined = refinement_.refine(map_, T_map_lidar, search_radius_m, first, points_,
                                   known_.noise_scale, /*map_sigma_m=*/0, &prior);
  if (!fit.refined.valid) return fit;
  meet(fit.refined.T_map_lidar);
  const BeamCounts rays = beam_model_.counts();
  if (rays.explains_scan()) fit.rays = rays;
  return fit;
}

VerifiedHypothesis PlaceFitter::with_offsets(const Pose2& T_map_lidar, double search_radius_m,
                                             double map_sigma_m, const RefinedPose& exact) {
  VerifiedHypothesis fit;
  const PosePrior prior = PosePrior::near_to(T_map_lidar);
  const auto refine = [&](double sigma_m) {
    fit.map_sigma_m = sigma_m;
    fit.refined = refinement_.refine(map_, T_map_lidar, search_radius_m, few_, points_,
                                     known_.noise_scale, sigma_m, &prior);
  };
  const double stated_m = map_.plan().sigma_m;
  if (map_.plan().is_inexact()) {
    refine(stated_m);
  } else if (map_sigma_m > BeamModel::kMapSigmas_m.front()) {
    refine(map_sigma_m);
  } else {
    // With no offsets walls that are off would be left out, and not seen to be.
    if (may_be_off()) refine(stated_m);
    if (!may_be_off() || fit.refined.face_residuals.excludes_offsets()) {
      fit.refined = exact;
      fit.map_sigma_m = 0;
    }
  }
  return fit;
}

bool PlaceFitter::is_exact(const VerifiedHypothesis& fit) const {
  const BeamCounts& rays = fit.rays;
  if (!may_be_off() && rays.hit_share() > kExactMapShare) return true;
  const auto at_walls =
      static_cast<double>(rays.hits + rays.near_hits + rays.free_space_violations);
  return rays.hits > 0 && static_cast<double>(rays.hits) > kExactShare * at_walls &&
         (!may_be_off() || fit.refined.face_residuals.excludes_offsets());
}

bool PlaceFitter::is_determined(const RefinedPose& refined) const {
  const std::optional<Prior>& prior = known_.prior;
  const bool is_held =
      refined.is_held() || (prior && prior->position_error_m < kSurePrior_m &&
                            same_pose(prior->T_map_lidar, refined.T_map_lidar,
                                      kSurePrior_m + prior->position_error_m, kJump_rad));
  const double stated_m = map_.plan().sigma_m;
  const double max_rmse_m =
      std::max(kMaxRmseSigmas * BeamModel::kMapSigmas_m.back(), kMaxRmseSigmasStated * stated_m);
  const double variance_m2 = refined.covariance(0, 0) + refined.covariance(1, 1);
  return is_held && refined.rmse_m <= max_rmse_m && variance_m2 <= squared(kMaxSigma_m + stated_m);
}

}  // namespace cornerd::core
