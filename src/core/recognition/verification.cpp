// SPDX-License-Identifier: MIT
#include "core/recognition/verification.hpp"

#include <algorithm>
#include <cmath>

#include "core/recognition/evidence.hpp"
#include "core/recognition/recognition.hpp"

namespace cornerd::core {
namespace {

/// Rays of the rough test: enough that no room passes for another by chance.
constexpr std::size_t kThinRays = 90;
/// Refined at most: look-alikes of one building are few, the rest is waste.
constexpr std::size_t kMaxExamined = 24;

constexpr double kMinRoughHits = 0.4;
constexpr double kMaxRoughThrough = 0.35;
/// After it was refined on few rays, a place this far behind the best one is no rival, neither by
/// rays nor by things. Places that all rays left in doubt were behind by up to 27 with clear turns,
/// and by 74 where most rays were missing and many others belonged to nothing on the map.
constexpr double kRoughMargin = 60;
constexpr double kRoughMarginPerStranger = 2;
/// The same before it was refined: up to 68, and 169.
constexpr double kUnrefinedMargin = 150;
/// What is left to refine then.
constexpr double kRefinedReach_m = 0.01;

// A right place: at least half of the rays end on the map's walls (the rest may be people and
// chairs), and hardly any goes through a wall. The two walls of one corner fit to any other corner,
// so that a turn of few rays needs more than half.
constexpr std::size_t kMinSurplus = 30;
constexpr double kMinHitShare = 0.25;
constexpr double kMaxThrough = 0.08;
/// A pose that is known no better than this is no pose: a lone wall, a bare corridor.
constexpr double kMaxPoseSigma_m = 0.05;
constexpr double kMaxSigma_rad = radians(3);

}  // namespace

Verification::Verification(const WallMap& map, const LocalizerConfig& config)
    : map_(map),
      noise_(config.noise),
      prediction_(config.max_range_m),
      refinement_(config.max_range_m, config.noise) {
  thin_.reserve(2 * kThinRays);
  candidates_.reserve(Recognition::kMaxHypotheses);
  places_.reserve(kMaxPlaces);
}

void Verification::begin(std::span<const PolarPoint> points, double noise_scale) {
  points_ = points;
  noise_scale_ = noise_scale;
  places_.clear();
  best_ = {};
  thin_.clear();
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kThinRays);
  for (std::size_t i = 0; i < points.size(); i += stride) thin_.push_back(points[i]);
}

void Verification::consider(std::span<const Hypothesis> hypotheses, double reach_m) {
  shortlist(hypotheses, reach_m);
  refine_roughly(reach_m);
  for (const Candidate& candidate : candidates_) examine(candidate.T_map_lidar);
  // Not stable_sort, which takes memory; ties are broken by the place.
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    if (a.explanation.log_likelihood != b.explanation.log_likelihood) {
      return a.explanation.log_likelihood > b.explanation.log_likelihood;
    }
    return a.refined.T_map_lidar.x_m < b.refined.T_map_lidar.x_m;
  });
}

void Verification::shortlist(std::span<const Hypothesis> hypotheses, double reach_m) {
  candidates_.clear();
  for (const Hypothesis& hypothesis : hypotheses) {
    const auto hits = prediction_.cast_near(map_, hypothesis.T_map_lidar, thin_);
    const Explanation rough =
        explain(map_, thin_, hits, hypothesis.T_map_lidar, noise_, noise_scale_, reach_m / 2);
    if (rough.hit_share() < kMinRoughHits || rough.through_share() > kMaxRoughThrough) continue;
    if (candidates_.size() < candidates_.capacity()) {
      candidates_.push_back({hypothesis.T_map_lidar, rough.log_likelihood,
                             rough.log_likelihood_of_things, rough.hits + rough.near});
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    if (a.log_likelihood != b.log_likelihood) return a.log_likelihood > b.log_likelihood;
    return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
  });
}

void Verification::refine_roughly(double reach_m) {
  candidates_.resize(std::min(candidates_.size(), kMaxExamined));
  const double unrefined_best = candidates_.empty() ? 0 : candidates_.front().log_likelihood;
  std::size_t kept = 0;
  for (const Candidate& candidate : candidates_) {
    if (candidate.log_likelihood < unrefined_best - kUnrefinedMargin - margin_of_strangers()) break;
    if (is_settled(candidate.T_map_lidar)) continue;
    const RefinedPose refined =
        refinement_.approach(map_, candidate.T_map_lidar, reach_m, thin_, noise_scale_);
    if (!refined.valid) continue;
    const auto hits = prediction_.cast_near(map_, refined.T_map_lidar, thin_);
    const Explanation rough =
        explain(map_, thin_, hits, refined.T_map_lidar, noise_, noise_scale_, 0);
    if (rough.log_likelihood > best_.log_likelihood) {
      best_.log_likelihood = rough.log_likelihood;
      best_.explained = rough.hits + rough.near;
      best_.strangers = rough.rays - rough.hits;
    }
    best_.log_likelihood_of_things =
        std::max(best_.log_likelihood_of_things, rough.log_likelihood_of_things);
    candidates_[kept++] = {refined.T_map_lidar, rough.log_likelihood,
                           rough.log_likelihood_of_things, rough.hits + rough.near};
  }
  candidates_.resize(kept);
  const double margin = kRoughMargin + margin_of_strangers();
  // One that explains more rays, however roughly, is a rival to the end: the lidar may be biased.
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    return candidate.explained <= best_.explained &&
           candidate.log_likelihood < best_.log_likelihood - margin &&
           candidate.log_likelihood_of_things < best_.log_likelihood_of_things - margin;
  });
}

double Verification::margin_of_strangers() const {
  return kRoughMarginPerStranger * static_cast<double>(best_.strangers);
}

bool Verification::is_settled(const Pose2& T_map_lidar) const {
  return std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    return same_place(place.refined.T_map_lidar, T_map_lidar, kDistinct_m, kDistinct_rad) &&
           leaves_no_doubt(place.explanation, /*expected=*/false);
  });
}

void Verification::examine(const Pose2& T_map_lidar) {
  if (is_known(T_map_lidar)) return;
  Place place;
  place.refined =
      refinement_.refine(map_, T_map_lidar, kRefinedReach_m, thin_, points_, noise_scale_);
  if (!place.refined.valid || is_known(place.refined.T_map_lidar)) return;
  const auto hits = prediction_.cast(map_, place.refined.T_map_lidar, points_);
  place.explanation =
      explain(map_, points_, hits, place.refined.T_map_lidar, noise_, noise_scale_, 0);
  if (passes(place) && places_.size() < kMaxPlaces) places_.push_back(place);
}

bool Verification::is_known(const Pose2& T_map_lidar) const {
  return std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    return same_place(place.refined.T_map_lidar, T_map_lidar, kDistinct_m, kDistinct_rad);
  });
}

bool Verification::passes(const Place& place) const {
  const Covariance3& covariance = place.refined.covariance;
  const Explanation& explanation = place.explanation;
  const std::size_t explained = explanation.hits + explanation.near;
  return explained >= explanation.rays - explained + kMinSurplus &&
         explanation.hit_share() >= kMinHitShare && explanation.through_share() <= kMaxThrough &&
         covariance(0, 0) + covariance(1, 1) < kMaxPoseSigma_m * kMaxPoseSigma_m &&
         covariance(2, 2) < kMaxSigma_rad * kMaxSigma_rad;
}

}  // namespace cornerd::core
