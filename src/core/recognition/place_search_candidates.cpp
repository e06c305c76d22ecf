// SPDX-License-Identifier: MIT
// From hypotheses to the few candidates that are worth a fit of all rays.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/recognition/place_search.hpp"

namespace cornerd::core {
namespace {

/// Candidates that are refined on few rays.
constexpr std::size_t kMaxRefined = 16;
/// Rough score, of 1, from which a candidate may fit exactly: nearly all few rays are on walls.
constexpr double kMayBeExact = 0.9;
/// Rough score of a place that may be the right one.
constexpr double kMayBeRight = 0.5;
/// Places whose rough scores differ by less may be alike.
constexpr double kAlike = 0.03;
/// Candidates that refinement leads to one place from, and one candidate.
constexpr double kApart_m = 0.1;
constexpr double kApart_rad = 0.05;
constexpr double kSame_m = 0.06;
constexpr double kSame_rad = 0.04;
/// How candidates are refined roughly: with free offsets from a pair of corners, a decimetre off,
/// and with none from a search in cells of 5 cm. With free offsets walls follow the things that
/// stand before them; with none, walls that are off do not fit.
struct RoughRefinement {
  double radius_m;
  double map_sigma_m;
};
constexpr std::array kRoughRefinements = {RoughRefinement{0.12, 0.025}, RoughRefinement{0.045, 0}};

}  // namespace

void PlaceSearch::consider(std::span<const PoseHypothesis> hypotheses, bool are_sure) {
  for (const PoseHypothesis& hypothesis : hypotheses) {
    if (candidates_.size() == kMaxCandidates) return;
    if (is_compared(hypothesis.T_map_lidar)) continue;
    const double score = fitter_.rough_score(hypothesis.T_map_lidar);
    if (!are_sure) best_rough_score_ = std::max(best_rough_score_, score);
    candidates_.push_back({hypothesis.T_map_lidar, score, 0, are_sure});
  }
}

void PlaceSearch::consider_prior(const Pose2& T_map_lidar, double search_radius_m) {
  if (add_if_exact(fitter_.exactly(T_map_lidar, search_radius_m, points_))) return;
  const PoseHypothesis prior{T_map_lidar, 0};
  consider(std::span(&prior, 1), /*are_sure=*/true);
}

bool PlaceSearch::add_if_exact(const VerifiedHypothesis& fit) {
  const bool is_exact = fitter_.is_exact(fit);
  if (is_exact) add(fit, {});
  return is_exact;
}

bool PlaceSearch::is_better(const Candidate& a, const Candidate& b) {
  if (a.is_sure != b.is_sure) return a.is_sure;
  if (a.score != b.score) return a.score > b.score;
  if (a.T_map_lidar.x_m != b.T_map_lidar.x_m) return a.T_map_lidar.x_m < b.T_map_lidar.x_m;
  if (a.T_map_lidar.y_m != b.T_map_lidar.y_m) return a.T_map_lidar.y_m < b.T_map_lidar.y_m;
  return a.T_map_lidar.theta_rad < b.T_map_lidar.theta_rad;
}

const VerifiedHypothesis* PlaceSearch::exact_place() const {
  const auto found = std::find_if(places_.begin(), places_.end(),
                                  [](const VerifiedHypothesis& place) { return place.is_exact; });
  return found != places_.end() ? &*found : nullptr;
}

void PlaceSearch::fit_best_exactly() {
  if (exact_place() != nullptr || candidates_.empty() || candidates_.front().is_sure) return;
  std::size_t kept = 0;
  std::size_t tried = 0;
  bool found = false;
  for (const Candidate& candidate : candidates_) {
    const Pose2& T_map_lidar = candidate.T_map_lidar;
    const auto is_there = [&](const VerifiedHypothesis& place) {
      return place.is_exact && is_one_place(place.refined.T_map_lidar, T_map_lidar);
    };
    if (found && std::any_of(places_.begin(), places_.end(), is_there)) continue;
    if (candidate.score >= kMayBeExact && (tried == 0 || (found && tried < kMaxCompared))) {
      ++tried;
      tried_ = fitter_.exactly(T_map_lidar, kRoughRefinements.front().radius_m);
      if (add_if_exact(tried_)) {
        found = true;
        continue;
      }
    } else if (found && tried == kMaxCompared && is_as_good_as_the_best(candidate)) {
      leave_out(candidate);
    }
    candidates_[kept++] = candidate;
  }
  candidates_.resize(kept);
}

VerifiedHypothesis PlaceSearch::fitted_exactly(const Pose2& T_map_lidar) {
  const bool was_tried = tried_.refined.valid &&
                         same_pose(tried_.refined.T_map_lidar, T_map_lidar, kSame_m, kSame_rad);
  return was_tried ? tried_ : fitter_.exactly(T_map_lidar, kFewRaysRadius_m);
}

PlaceSearch::Candidate PlaceSearch::by_few_rays(const Pose2& T_map_lidar) {
  const BeamStatistics rays = fitter_.statistics_of_few(T_map_lidar);
  return {T_map_lidar, log_odds_of_place(rays, wall_ends(T_map_lidar), structure_),
          rays.map_sigma_m};
}

PlaceSearch::Candidate PlaceSearch::refined_roughly(const Candidate& candidate,
                                                    double least_score) {
  Candidate best{candidate.T_map_lidar, -std::numeric_limits<double>::infinity(), 0};
  for (const RoughRefinement& rough : kRoughRefinements) {
    if (std::isfinite(best.score) && best.score < least_score) break;
    const auto refined = fitter_.roughly(candidate.T_map_lidar, rough.radius_m, rough.map_sigma_m);
    if (!refined) continue;
    const Candidate there = by_few_rays(*refined);
    if (there.score > best.score) best = there;
  }
  return best;
}

bool PlaceSearch::is_compared(const Pose2& T_map_lidar) const {
  return std::any_of(places_.begin(), places_.end(), [&](const VerifiedHypothesis& place) {
    return same_pose(place.refined.T_map_lidar, T_map_lidar, kSame_m, kSame_rad);
  });
}

bool PlaceSearch::is_candidate(const Pose2& T_map_lidar, std::size_t kept, double near_m,
                               double near_rad) const {
  const auto others = std::span(candidates_).first(kept);
  return std::any_of(others.begin(), others.end(), [&](const Candidate& other) {
    return same_pose(other.T_map_lidar, T_map_lidar, near_m, near_rad);
  });
}

bool PlaceSearch::is_known(const Pose2& T_map_lidar, std::size_t kept) const {
  return is_compared(T_map_lidar) || is_candidate(T_map_lidar, kept, kSame_m, kSame_rad);
}

bool PlaceSearch::is_as_good_as_the_best(const Candidate& candidate) const {
  return candidate.score > std::max(kMayBeRight, best_rough_score_ - kAlike);
}

void PlaceSearch::leave_out(const Candidate& candidate) {
  if (left_out_.size() < kMaxCandidates) left_out_.push_back(candidate.T_map_lidar);
}

void PlaceSearch::take_distinct() {
  std::size_t kept = 0;
  for (const Candidate& candidate : candidates_) {
    const bool has_room = kept < kMaxRefined;
    if (!has_room && !is_as_good_as_the_best(candidate)) continue;
    if (is_candidate(candidate.T_map_lidar, kept, kApart_m, kApart_rad)) continue;
    if (has_room) {
      candidates_[kept++] = candidate;
    } else {
      leave_out(candidate);
    }
  }
  candidates_.resize(kept);
}

void PlaceSearch::refine_roughly() {
  take_distinct();
  const VerifiedHypothesis* exact = exact_place();
  if (exact != nullptr && !candidates_.empty()) {
    best_score_ = std::max(best_score_, by_few_rays(exact->refined.T_map_lidar).score);
  }
  std::size_t kept = 0;
  for (const Candidate& candidate : candidates_) {
    if (is_known(candidate.T_map_lidar, kept)) continue;
    const Candidate best = refined_roughly(candidate, best_score_ - kHopeless);
    if (!std::isfinite(best.score) || is_known(best.T_map_lidar, kept)) continue;
    candidates_[kept++] = best;
    best_score_ = std::max(best_score_, best.score);
  }
  candidates_.resize(kept);
  std::sort(candidates_.begin(), candidates_.end(), is_better);
}

}  // namespace cornerd::core
