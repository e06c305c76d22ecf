// SPDX-License-Identifier: MIT
#include "core/recognition/verification.hpp"

#include <algorithm>
#include <cmath>

#include "core/recognition/evidence.hpp"
#include "core/recognition/recognition.hpp"

namespace cornerd::core {
namespace {

/// Rays of the rough test: enough to tell rooms apart.
constexpr std::size_t kSubsetRays = 90;
/// Limit of refined hypotheses: one building has few look-alikes.
constexpr std::size_t kMaxExamined = 24;

constexpr double kMinRoughHitShare = 0.4;
constexpr double kMaxRoughViolations = 0.35;
/// Margin of log-likelihood behind the best hypothesis after refinement on the subset of rays, by
/// rays and by obstacles. Hypotheses that stayed ambiguous on all rays were behind by up to 27 in
/// clear scans, and by 74 where most rays were missing or hit unmapped obstacles.
constexpr double kRoughMargin = 60;
/// The same before refinement: 68 and 169 observed.
constexpr double kUnrefinedMargin = 150;
/// Remaining error after the rough refinement.
constexpr double kRefinedRadius_m = 0.01;

// A verified pose: at least half of the rays hit the map's walls (the rest may be people and
// chairs), with hardly any free-space violation. The two walls of one corner fit any other corner,
// so that scans of few rays need more than half.
constexpr std::size_t kMinSurplus = 30;
constexpr double kMinHitShare = 0.25;
constexpr double kMaxViolations = 0.08;
/// A less certain pose is open: a single wall, a bare corridor.
constexpr double kMaxPoseSigma_m = 0.05;
constexpr double kMaxSigma_rad = radians(3);

bool explains(const BeamLikelihood& likelihood) {
  const std::size_t on_walls = likelihood.hits + likelihood.near_hits;
  return on_walls >= likelihood.rays - on_walls + kMinSurplus &&
         likelihood.hit_share() >= kMinHitShare && likelihood.violation_share() <= kMaxViolations;
}

bool is_determined(const Covariance3& covariance) {
  return covariance(0, 0) + covariance(1, 1) < kMaxPoseSigma_m * kMaxPoseSigma_m &&
         covariance(2, 2) < kMaxSigma_rad * kMaxSigma_rad;
}

}  // namespace

Verification::Verification(const WallMap& map, const LocalizerConfig& config)
    : map_(map),
      noise_(config.noise),
      ray_caster_(config.max_range_m),
      refinement_(config.max_range_m, config.noise) {
  subset_.reserve(2 * kSubsetRays);
  candidates_.reserve(Recognition::kMaxHypotheses);
  hypotheses_.reserve(kMaxVerified);
  open_.reserve(kMaxVerified);
}

void Verification::begin(std::span<const PolarPoint> points, double noise_scale) {
  points_ = points;
  noise_scale_ = noise_scale;
  hypotheses_.clear();
  open_.clear();
  best_ = {};
  subset_.clear();
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSubsetRays);
  for (std::size_t i = 0; i < points.size(); i += stride) subset_.push_back(points[i]);
}

void Verification::consider(std::span<const PoseHypothesis> hypotheses, double search_radius_m) {
  shortlist(hypotheses, search_radius_m);
  refine_roughly(search_radius_m);
  for (const Candidate& candidate : candidates_) {
    examine(candidate.T_map_lidar, kRefinedRadius_m, subset_);
  }
  sort();
}

void Verification::consider_prior(const Pose2& T_map_lidar, double search_radius_m) {
  const PoseHypothesis prior{T_map_lidar, 0};
  shortlist(std::span(&prior, 1), search_radius_m);
  if (!candidates_.empty()) examine(T_map_lidar, search_radius_m, points_);
  sort();
}

void Verification::sort() {
  // std::stable_sort would allocate; ties are broken by position.
  std::sort(hypotheses_.begin(), hypotheses_.end(),
            [](const VerifiedHypothesis& a, const VerifiedHypothesis& b) {
              if (a.likelihood.log_likelihood != b.likelihood.log_likelihood) {
                return a.likelihood.log_likelihood > b.likelihood.log_likelihood;
              }
              return a.refined.T_map_lidar.x_m < b.refined.T_map_lidar.x_m;
            });
}

void Verification::shortlist(std::span<const PoseHypothesis> hypotheses, double search_radius_m) {
  candidates_.clear();
  for (const PoseHypothesis& hypothesis : hypotheses) {
    const auto hits = ray_caster_.cast_near(map_, hypothesis.T_map_lidar, subset_);
    const BeamLikelihood rough = beam_likelihood(map_, subset_, hits, hypothesis.T_map_lidar,
                                                 noise_, noise_scale_, search_radius_m / 2);
    if (rough.hit_share() < kMinRoughHitShare || rough.violation_share() > kMaxRoughViolations)
      continue;
    if (candidates_.size() < candidates_.capacity()) {
      candidates_.push_back({hypothesis.T_map_lidar, rough.log_likelihood,
                             rough.log_likelihood_of_obstacles, rough.hits + rough.near_hits});
    }
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    if (a.log_likelihood != b.log_likelihood) return a.log_likelihood > b.log_likelihood;
    return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
  });
}

void Verification::refine_roughly(double search_radius_m) {
  candidates_.resize(std::min(candidates_.size(), kMaxExamined));
  const double unrefined_best = candidates_.empty() ? 0 : candidates_.front().log_likelihood;
  std::size_t kept = 0;
  for (const Candidate& candidate : candidates_) {
    if (candidate.log_likelihood < unrefined_best - kUnrefinedMargin) break;
    if (is_unambiguous(candidate.T_map_lidar)) continue;
    const RefinedPose refined = refinement_.refine_roughly(map_, candidate.T_map_lidar,
                                                           search_radius_m, subset_, noise_scale_);
    if (!refined.valid) continue;
    const auto hits = ray_caster_.cast_near(map_, refined.T_map_lidar, subset_);
    const BeamLikelihood rough =
        beam_likelihood(map_, subset_, hits, refined.T_map_lidar, noise_, noise_scale_, 0);
    // explains() asks for more.
    if (2 * (rough.hits + rough.near_hits) < rough.rays) continue;
    if (rough.log_likelihood > best_.log_likelihood) {
      best_.log_likelihood = rough.log_likelihood;
      best_.on_walls = rough.hits + rough.near_hits;
    }
    best_.log_likelihood_of_obstacles =
        std::max(best_.log_likelihood_of_obstacles, rough.log_likelihood_of_obstacles);
    candidates_[kept++] = {refined.T_map_lidar, rough.log_likelihood,
                           rough.log_likelihood_of_obstacles, rough.hits + rough.near_hits};
  }
  candidates_.resize(kept);
  // A hypothesis with more rays on walls stays, however roughly they fit: the lidar may be biased.
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    return candidate.on_walls <= best_.on_walls &&
           candidate.log_likelihood < best_.log_likelihood - kRoughMargin &&
           candidate.log_likelihood_of_obstacles < best_.log_likelihood_of_obstacles - kRoughMargin;
  });
}

bool Verification::is_unambiguous(const Pose2& T_map_lidar) const {
  return std::any_of(
      hypotheses_.begin(), hypotheses_.end(), [&](const VerifiedHypothesis& hypothesis) {
        return same_pose(hypothesis.refined.T_map_lidar, T_map_lidar, kDistinct_m, kDistinct_rad) &&
               is_conclusive(hypothesis.likelihood, /*expected=*/false);
      });
}

void Verification::examine(const Pose2& T_map_lidar, double search_radius_m,
                           std::span<const PolarPoint> first) {
  if (is_duplicate(T_map_lidar)) return;
  VerifiedHypothesis hypothesis;
  const PosePrior prior = PosePrior::near_to(T_map_lidar);
  hypothesis.refined = refinement_.refine(map_, T_map_lidar, search_radius_m, first, points_,
                                          noise_scale_, /*map_sigma_m=*/0, &prior);
  if (!hypothesis.refined.valid || is_duplicate(hypothesis.refined.T_map_lidar)) return;
  const auto hits = ray_caster_.cast(map_, hypothesis.refined.T_map_lidar, points_);
  hypothesis.likelihood =
      beam_likelihood(map_, points_, hits, hypothesis.refined.T_map_lidar, noise_, noise_scale_, 0);
  if (!explains(hypothesis.likelihood)) return;
  auto& kind = is_determined(hypothesis.refined.covariance) ? hypotheses_ : open_;
  if (kind.size() < kMaxVerified) kind.push_back(hypothesis);
}

bool Verification::is_duplicate(const Pose2& T_map_lidar) const {
  return std::any_of(
      hypotheses_.begin(), hypotheses_.end(), [&](const VerifiedHypothesis& hypothesis) {
        return same_pose(hypothesis.refined.T_map_lidar, T_map_lidar, kDistinct_m, kDistinct_rad);
      });
}

}  // namespace cornerd::core
