// SPDX-License-Identifier: MIT
#include "core/recognition/place_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/squared.hpp"

namespace cornerd::core {
namespace {

constexpr std::size_t kFewRays = 90;
/// Candidates that are refined on few rays, and on all.
constexpr std::size_t kMaxRefined = 16;
constexpr std::size_t kMaxCompared = 12;
/// A ray on the wall that is predicted, roughly (m).
constexpr double kRoughHit_m = 0.12;
/// Remaining error of one that was refined on few rays (m).
constexpr double kFewRaysRadius_m = 0.03;
/// Refinement that leads farther away has left its place.
constexpr double kMaxMove_m = 0.5;
constexpr double kMaxMove_rad = 0.3;
/// Nats behind the likeliest on few rays, beyond which none was the right one.
constexpr double kHopeless = 16;
/// One candidate, and one place.
constexpr double kSame_m = 0.06;
constexpr double kSame_rad = 0.04;
constexpr double kOnePlace_m = 0.3;
constexpr double kOnePlace_rad = 0.15;
/// How candidates are refined roughly: with free offsets from a pair of corners, a decimetre off,
/// and with none from a search in cells of 5 cm. With free offsets walls follow the things that
/// stand before them; with none, walls that are off do not fit.
struct RoughRefinement {
  double radius_m;
  double map_sigma_m;
};
constexpr std::array kRoughRefinements = {RoughRefinement{0.12, 0.025}, RoughRefinement{0.045, 0}};
/// A pose that is less certain than this beyond the map is not named: a single wall, a bare
/// corridor. It is a rival to those that are.
constexpr double kMaxSigma_m = 0.1;
/// Residuals are the walls' offsets up to so many of their standard deviations; greater ones are of
/// a motion.
constexpr double kMaxRmseSigmas = 1.3;
constexpr double kMaxRmseSigmasStated = 2;

}  // namespace

PlaceSearch::PlaceSearch(const WallMap& map, const Recognition& recognition,
                         const LocalizerConfig& config)
    : map_(map),
      recognition_(recognition),
      ray_caster_(config.max_range_m),
      refinement_(config.max_range_m, config.noise),
      beam_model_(map, config.noise) {
  subset_.reserve(2 * kFewRays);
  candidates_.reserve(kMaxCandidates);
  places_.reserve(kMaxCompared);
  open_places_.reserve(kMaxCompared);
}

void PlaceSearch::begin(const PolarScan& scan, std::span<const WallSegment> segments,
                        std::span<const Breakpoint> breakpoints, double noise_scale,
                        double max_map_sigma_m, bool fits_motion) {
  points_ = scan.points();
  odds_elsewhere_ = fits_motion ? std::pow(static_cast<double>(points_.size()), 1.5) : 1;
  max_map_sigma_m_ = max_map_sigma_m;
  breakpoints_ = breakpoints;
  spacing_rad_ = scan.spacing_rad();
  noise_scale_ = noise_scale;
  structure_ = scan_structure(segments);
  candidates_.clear();
  places_.clear();
  subset_.clear();
  const std::size_t stride = std::max<std::size_t>(1, points_.size() / kFewRays);
  for (std::size_t i = 0; i < points_.size(); i += stride) subset_.push_back(points_[i]);
}

double PlaceSearch::rough_score(const Pose2& T_map_lidar) {
  const auto hits = ray_caster_.cast_near(map_, T_map_lidar, subset_);
  const double c = std::cos(T_map_lidar.theta_rad);
  const double s = std::sin(T_map_lidar.theta_rad);
  double score = 0;
  for (std::size_t i = 0; i < subset_.size(); ++i) {
    if (hits[i].face == PredictedHit::kNone) {
      score -= 0.5;
      continue;
    }
    const PolarPoint& point = subset_[i];
    const Vec2& normal = map_.faces()[hits[i].face].normal;
    const double across_m = (point.range_m - hits[i].range_m) *
                            std::abs(normal.x() * (c * point.ray_x - s * point.ray_y) +
                                     normal.y() * (s * point.ray_x + c * point.ray_y));
    if (std::abs(across_m) < kRoughHit_m) {
      score += 1;
    } else if (across_m > 0) {
      score -= 1;
    }
  }
  return score;
}

void PlaceSearch::consider(std::span<const PoseHypothesis> hypotheses) {
  for (const PoseHypothesis& hypothesis : hypotheses) {
    if (candidates_.size() == kMaxCandidates) return;
    candidates_.push_back({hypothesis.T_map_lidar, rough_score(hypothesis.T_map_lidar), 0});
  }
}

PlaceSearch::Candidate PlaceSearch::refined_roughly(const Candidate& candidate, double spacing_rad,
                                                    double least_score) {
  Candidate best{candidate.T_map_lidar, -std::numeric_limits<double>::infinity(), 0};
  for (const RoughRefinement& rough : kRoughRefinements) {
    if (std::isfinite(best.score) && best.score < least_score) break;
    const RefinedPose refined = refinement_.refine_roughly(
        map_, candidate.T_map_lidar, rough.radius_m, subset_, noise_scale_, rough.map_sigma_m);
    if (!refined.valid ||
        !same_pose(refined.T_map_lidar, candidate.T_map_lidar, kMaxMove_m, kMaxMove_rad)) {
      continue;
    }
    const auto hits = ray_caster_.cast(map_, refined.T_map_lidar, subset_);
    const BeamStatistics statistics = beam_model_.statistics(
        subset_, hits, refined.T_map_lidar, spacing_rad, noise_scale_, max_map_sigma_m_);
    const double log_odds =
        log_odds_of_place(statistics, wall_ends(refined.T_map_lidar), structure_);
    if (log_odds > best.score) best = {refined.T_map_lidar, log_odds, statistics.map_sigma_m};
  }
  return best;
}

void PlaceSearch::refine_roughly() {
  const auto is_better = [](const Candidate& a, const Candidate& b) {
    if (a.score != b.score) return a.score > b.score;
    if (a.T_map_lidar.x_m != b.T_map_lidar.x_m) return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
    return a.T_map_lidar.theta_rad < b.T_map_lidar.theta_rad;
  };
  std::sort(candidates_.begin(), candidates_.end(), is_better);
  const double spacing_rad = spacing_rad_ * static_cast<double>(points_.size()) /
                             static_cast<double>(std::max<std::size_t>(1, subset_.size()));
  candidates_.resize(std::min(candidates_.size(), kMaxRefined));
  std::size_t kept = 0;
  double best_score = 0;  // of elsewhere
  for (const Candidate& candidate : candidates_) {
    const auto is_known = [&](const Pose2& T_map_lidar) {
      return std::any_of(candidates_.begin(),
                         candidates_.begin() + static_cast<std::ptrdiff_t>(kept),
                         [&](const Candidate& other) {
                           return same_pose(other.T_map_lidar, T_map_lidar, kSame_m, kSame_rad);
                         });
    };
    if (is_known(candidate.T_map_lidar)) continue;
    const Candidate best = refined_roughly(candidate, spacing_rad, best_score - kHopeless);
    if (!std::isfinite(best.score) || is_known(best.T_map_lidar)) continue;
    candidates_[kept++] = best;
    best_score = std::max(best_score, best.score);
  }
  candidates_.resize(kept);
  std::sort(candidates_.begin(), candidates_.end(), is_better);
}

double PlaceSearch::wall_ends(const Pose2& T_map_lidar) const {
  int count = 0;
  for (const Breakpoint& breakpoint : breakpoints_) {
    if (breakpoint.kind != BreakpointKind::kTerminal) continue;
    count += recognition_.recognised(std::span(&breakpoint, 1), T_map_lidar);
  }
  return count;
}

void PlaceSearch::add(const Candidate& candidate) {
  VerifiedHypothesis place;
  const PosePrior prior = PosePrior::near_to(candidate.T_map_lidar);
  const auto refine = [&](double map_sigma_m) {
    place.map_sigma_m = map_sigma_m;
    place.refined = refinement_.refine(map_, candidate.T_map_lidar, kFewRaysRadius_m, subset_,
                                       points_, noise_scale_, map_sigma_m, &prior);
  };
  const double stated_m = map_.plan().sigma_m;
  if (map_.plan().is_inexact()) {
    refine(stated_m);
  } else if (candidate.map_sigma_m > BeamModel::kMapSigmas_m.front()) {
    refine(candidate.map_sigma_m);
  } else {
    // Where the walls are exact, so is the pose, and what does not fit is a motion. With no offsets
    // walls that are off would be left out, and not seen to be.
    const bool may_be_off = max_map_sigma_m_ > BeamModel::kMapSigmas_m.front();
    if (may_be_off) refine(stated_m);
    if (!may_be_off || !place.refined.face_residuals.shows_offsets()) refine(0);
  }
  const double max_rmse_m =
      std::max(kMaxRmseSigmas * BeamModel::kMapSigmas_m.back(), kMaxRmseSigmasStated * stated_m);
  if (!place.refined.valid) return;
  const Covariance3& covariance = place.refined.covariance;
  const bool is_determined = place.refined.is_held() && place.refined.rmse_m <= max_rmse_m &&
                             covariance(0, 0) + covariance(1, 1) <= squared(kMaxSigma_m + stated_m);
  const auto hits = ray_caster_.cast(map_, place.refined.T_map_lidar, points_);
  const BeamStatistics statistics = beam_model_.statistics(
      points_, hits, place.refined.T_map_lidar, spacing_rad_, noise_scale_, max_map_sigma_m_);
  place.log_odds = log_odds_of_place(statistics, wall_ends(place.refined.T_map_lidar), structure_);
  place.likelihood.rays = statistics.rays;
  place.likelihood.hits = statistics.hits;
  place.likelihood.shorts = statistics.shorts;
  place.likelihood.free_space_violations = statistics.throughs;
  const auto is_here = [&](const VerifiedHypothesis& other) {
    return same_pose(other.refined.T_map_lidar, place.refined.T_map_lidar, kOnePlace_m,
                     kOnePlace_rad);
  };
  const auto determined = std::find_if(places_.begin(), places_.end(), is_here);
  if (determined != places_.end()) {
    if (is_determined && place.log_odds > determined->log_odds) *determined = place;
    return;
  }
  const auto open = std::find_if(open_places_.begin(), open_places_.end(), is_here);
  if (is_determined) {
    if (open != open_places_.end()) open_places_.erase(open);
    places_.push_back(place);
  } else if (open == open_places_.end()) {
    open_places_.push_back(place);
  } else if (place.log_odds > open->log_odds) {
    *open = place;
  }
}

std::span<const VerifiedHypothesis> PlaceSearch::find() {
  refine_roughly();
  places_.clear();
  open_places_.clear();
  for (std::size_t i = 0; i < std::min(candidates_.size(), kMaxCompared); ++i) {
    if (candidates_[i].score < std::max(0.0, candidates_.front().score) - kHopeless) break;
    add(candidates_[i]);
  }
  // Elsewhere has odds of its own, and those of the places that the scan leaves open.
  double elsewhere = odds_elsewhere_;
  for (const VerifiedHypothesis& open : open_places_) elsewhere += std::exp(open.log_odds);
  for (VerifiedHypothesis& place : places_) place.log_odds -= std::log(elsewhere);
  std::sort(places_.begin(), places_.end(),
            [](const VerifiedHypothesis& a, const VerifiedHypothesis& b) {
              if (a.log_odds != b.log_odds) return a.log_odds > b.log_odds;
              return a.refined.T_map_lidar.x_m < b.refined.T_map_lidar.x_m;
            });
  return places_;
}

}  // namespace cornerd::core
