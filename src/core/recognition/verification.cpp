// SPDX-License-Identifier: MIT
#include "core/recognition/verification.hpp"

#include <algorithm>
#include <cmath>

#include "core/recognition/recognition.hpp"

namespace cornerd::core {
namespace {

/// Rays of the rough test: enough that no room passes for another by chance.
constexpr std::size_t kThinRays = 90;
/// Refined at most: look-alikes of one building are few, the rest is waste.
constexpr std::size_t kMaxExamined = 24;

constexpr double kMinRoughHits = 0.4;
constexpr double kMaxRoughThrough = 0.35;

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
  thin_.clear();
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kThinRays);
  for (std::size_t i = 0; i < points.size(); i += stride) thin_.push_back(points[i]);
}

void Verification::consider(std::span<const Hypothesis> hypotheses, double reach_m) {
  shortlist(hypotheses, reach_m);
  const std::size_t count = std::min(candidates_.size(), kMaxExamined);
  for (std::size_t i = 0; i < count; ++i) examine(candidates_[i].T_map_lidar, reach_m);
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
    const auto hits = prediction_.cast(map_, hypothesis.T_map_lidar, thin_);
    const Explanation rough =
        explain(map_, thin_, hits, hypothesis.T_map_lidar, noise_, noise_scale_, reach_m / 2);
    if (rough.hit_share() < kMinRoughHits || rough.through_share() > kMaxRoughThrough) continue;
    if (candidates_.size() < candidates_.capacity()) {
      candidates_.push_back({hypothesis.T_map_lidar, rough.log_likelihood});
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    if (a.log_likelihood != b.log_likelihood) return a.log_likelihood > b.log_likelihood;
    return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
  });
}

void Verification::examine(const Pose2& T_map_lidar, double reach_m) {
  Place place;
  place.refined = refinement_.refine(map_, T_map_lidar, reach_m, thin_, points_, noise_scale_);
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
