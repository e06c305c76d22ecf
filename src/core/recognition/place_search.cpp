// SPDX-License-Identifier: MIT
#include "core/recognition/place_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cornerd::core {
namespace {

/// Candidates that are refined on few rays, and on all.
constexpr std::size_t kMaxRefined = 16;
constexpr std::size_t kMaxCompared = 16;
/// The same where elsewhere is likelier than each, as in a motion that is not known yet.
constexpr std::size_t kMaxUnlikely = 3;
/// Rough score, of 1, from which a candidate may fit exactly: nearly all few rays are on walls.
constexpr double kMayBeExact = 0.9;
/// Remaining error of one that was refined on few rays (m).
constexpr double kFewRaysRadius_m = 0.03;
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
constexpr std::size_t kMaxPlaces = 48;

bool is_one_place(const VerifiedHypothesis& one, const VerifiedHypothesis& other) {
  return same_pose(one.refined.T_map_lidar, other.refined.T_map_lidar, kOnePlace_m, kOnePlace_rad);
}

}  // namespace

PlaceSearch::PlaceSearch(const WallMap& map, const Recognition& recognition,
                         const LocalizerConfig& config)
    : recognition_(recognition), fitter_(map, config) {
  candidates_.reserve(kMaxCandidates);
  places_.reserve(kMaxPlaces);
  open_places_.reserve(kMaxPlaces);
}

void PlaceSearch::begin(const PolarScan& scan, std::span<const WallSegment> segments,
                        std::span<const Breakpoint> breakpoints, const ScanPrior& known) {
  points_ = scan.points();
  known_ = known;
  breakpoints_ = breakpoints;
  structure_ = scan_structure(segments);
  fitter_.begin(scan, known);
  candidates_.clear();
  best_score_ = 0;
  places_.clear();
  open_places_.clear();
  exact_.reset();
  tried_ = {};
}

void PlaceSearch::consider(std::span<const PoseHypothesis> hypotheses, bool are_sure) {
  for (const PoseHypothesis& hypothesis : hypotheses) {
    if (candidates_.size() == kMaxCandidates) return;
    if (is_compared(hypothesis.T_map_lidar)) continue;
    candidates_.push_back(
        {hypothesis.T_map_lidar, fitter_.rough_score(hypothesis.T_map_lidar), 0, are_sure});
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
      return place.is_exact &&
             same_pose(place.refined.T_map_lidar, T_map_lidar, kOnePlace_m, kOnePlace_rad);
    };
    if (found && std::any_of(places_.begin(), places_.end(), is_there)) continue;
    if (candidate.score >= kMayBeExact && (tried == 0 || (found && tried < kMaxCompared))) {
      ++tried;
      tried_ = fitter_.exactly(T_map_lidar, kRoughRefinements.front().radius_m);
      if (add_if_exact(tried_)) {
        found = true;
        continue;
      }
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

bool PlaceSearch::is_known(const Pose2& T_map_lidar, std::size_t kept) const {
  const auto known = std::span(candidates_).first(kept);
  return is_compared(T_map_lidar) ||
         std::any_of(known.begin(), known.end(), [&](const Candidate& other) {
           return same_pose(other.T_map_lidar, T_map_lidar, kSame_m, kSame_rad);
         });
}

void PlaceSearch::refine_roughly() {
  candidates_.resize(std::min(candidates_.size(), kMaxRefined));
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

double PlaceSearch::wall_ends(const Pose2& T_map_lidar) const {
  int count = 0;
  for (const Breakpoint& breakpoint : breakpoints_) {
    if (breakpoint.kind != BreakpointKind::kTerminal) continue;
    count += recognition_.recognised(std::span(&breakpoint, 1), T_map_lidar);
  }
  return count;
}

void PlaceSearch::add(const VerifiedHypothesis& exact, const Candidate& candidate) {
  if (exact.rays.rays > 0 && (!exact_ || exact.rays.log_likelihood > exact_->rays.log_likelihood)) {
    exact_ = exact;
  }
  const bool is_exact = fitter_.is_exact(exact);
  VerifiedHypothesis place = is_exact
                                 ? exact
                                 : fitter_.with_offsets(candidate.T_map_lidar, kFewRaysRadius_m,
                                                        candidate.map_sigma_m, exact.refined);
  if (!place.refined.valid) return;
  place.is_exact = is_exact;
  const Pose2& T_map_lidar = place.refined.T_map_lidar;
  const BeamStatistics statistics = fitter_.statistics(place);
  place.evidence = log_odds_of_place(statistics, wall_ends(T_map_lidar), structure_);
  if (!is_exact) {
    place.rays = {.rays = statistics.rays,
                  .hits = statistics.hits,
                  .shorts = statistics.shorts,
                  .free_space_violations = statistics.free_space_violations};
  }
  const auto keep_in = [&](std::vector<VerifiedHypothesis>& places) {
    const auto known = std::find_if(places.begin(), places.end(),
                                    [&](const auto& other) { return is_one_place(other, place); });
    if (known == places.end()) {
      if (places.size() < kMaxPlaces) places.push_back(place);
    } else if (place.evidence > known->evidence) {
      *known = place;
    }
  };
  keep_in(fitter_.is_determined(place.refined) ? places_ : open_places_);
}

std::span<const VerifiedHypothesis> PlaceSearch::find() {
  std::sort(candidates_.begin(), candidates_.end(), is_better);
  fit_best_exactly();
  refine_roughly();
  const std::size_t most = best_score_ > 0 ? kMaxCompared : kMaxUnlikely;
  for (const Candidate& candidate :
       std::span(candidates_).first(std::min(candidates_.size(), most))) {
    if (best_score_ > 0 && candidate.score < best_score_ - kHopeless) break;
    add(fitted_exactly(candidate.T_map_lidar), candidate);
  }
  candidates_.clear();
  // Elsewhere has odds of its own, and those of the places that the scan leaves open.
  double elsewhere = known_.fits_motion ? std::pow(static_cast<double>(points_.size()), 1.5) : 1;
  for (const VerifiedHypothesis& open : open_places_) {
    const bool is_a_place = std::any_of(places_.begin(), places_.end(), [&](const auto& place) {
      return is_one_place(place, open);
    });
    if (!is_a_place) elsewhere += std::exp(open.evidence);
  }
  for (VerifiedHypothesis& place : places_) place.log_odds = place.evidence - std::log(elsewhere);
  std::sort(places_.begin(), places_.end(),
            [](const VerifiedHypothesis& a, const VerifiedHypothesis& b) {
              if (a.log_odds != b.log_odds) return a.log_odds > b.log_odds;
              return a.refined.T_map_lidar.x_m < b.refined.T_map_lidar.x_m;
            });
  return places_;
}

}  // namespace cornerd::core
