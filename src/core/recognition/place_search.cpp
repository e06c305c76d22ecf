// SPDX-License-Identifier: MIT
#include "core/recognition/place_search.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Candidates that are compared on all rays where elsewhere is likelier than each, as in a motion
/// that is not known yet.
constexpr std::size_t kMaxUnlikely = 3;
constexpr std::size_t kMaxPlaces = 48;

bool is_likelier(const VerifiedHypothesis& one, const VerifiedHypothesis& other) {
  if (one.log_odds != other.log_odds) return one.log_odds > other.log_odds;
  const Pose2& a = one.refined.T_map_lidar;
  const Pose2& b = other.refined.T_map_lidar;
  return a.x_m != b.x_m ? a.x_m < b.x_m : a.y_m < b.y_m;
}

}  // namespace

PlaceSearch::PlaceSearch(const WallMap& map, const Recognition& recognition,
                         const LocalizerConfig& config)
    : recognition_(recognition), fitter_(map, config) {
  candidates_.reserve(kMaxCandidates);
  places_.reserve(kMaxPlaces);
  open_places_.reserve(kMaxPlaces);
  left_out_.reserve(kMaxCandidates);
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
  best_rough_score_ = 0;
  left_out_.clear();
  places_.clear();
  open_places_.clear();
  exact_.reset();
  tried_ = {};
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
    const auto known = std::find_if(places.begin(), places.end(), [&](const auto& other) {
      return is_one_place(other.refined.T_map_lidar, T_map_lidar);
    });
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
      return is_one_place(place.refined.T_map_lidar, open.refined.T_map_lidar);
    });
    if (!is_a_place) elsewhere += std::exp(open.evidence);
  }
  for (VerifiedHypothesis& place : places_) place.log_odds = place.evidence - std::log(elsewhere);
  std::sort(places_.begin(), places_.end(), is_likelier);
  return places_;
}

bool PlaceSearch::is_complete() const {
  return std::all_of(left_out_.begin(), left_out_.end(), [&](const Pose2& T_map_lidar) {
    return std::any_of(places_.begin(), places_.end(), [&](const VerifiedHypothesis& place) {
      return is_one_place(place.refined.T_map_lidar, T_map_lidar);
    });
  });
}

}  // namespace cornerd::core
