// SPDX-License-Identifier: MIT
// From a turn to the places where it may have been taken.
#include <algorithm>
#include <array>

#include "core/localizer_workspace.hpp"
#include "core/recognition/evidence.hpp"

namespace cornerd::core {
namespace {

/// A place that recognition gave is off by up to this much; one that a prior leads to, by what it
/// says, within what a robot drives from turn to turn.
constexpr double kRecognisedRadius_m = 0.10;
constexpr double kPriorSearchRadius_m = 0.15;
constexpr double kSurePriorRadius_m = 0.03;
/// What a prior's heading is off by counts at walls that are so far away.
constexpr double kReach_m = 3;

/// Places with fewer votes of corners than this share of the best one's are looked at where those
/// with more leave doubt: in large buildings they are many.
constexpr double kLikelyShare = 0.7;

/// Hypotheses of pairs of corners that are compared in inexact maps, the most voted ones.
constexpr std::size_t kMaxPairs = 8;

/// A search that did not go on for longer is of another scan.
constexpr double kMaxSearchPause_s = 1;

/// The share of the rays that a place explains at least roughly where a bias is all that is wrong.
constexpr double kAllButExact = 0.95;

}  // namespace

void Localizer::Workspace::look(const Scan& scan, TimeNs t_ns, const ScanMotion& as_if_moving,
                                bool is_thorough) {
  // The returns in the order of their bearing, as a lidar that stood still would have seen them.
  motion = as_if_moving;
  points.assign(scan, config.min_range_m, config.max_range_m, t_ns, motion,
                place ? place->bias.bias() : config.bias);

  // Walls, and the corners and ends of walls between them (ALTBD).
  detector.detect(points, result.detection);
  if (!place) return;

  // The place where the robot should be by now, and those that pairs of corners point to.
  Verification& verification = place->verification;
  verification.begin(points.points(), noise_scale());
  if (const std::optional<Prior> prior = memory.prior(t_ns)) {
    const double off_m = prior->position_error_m + kReach_m * prior->heading_error_rad;
    verification.consider_prior(prior->T_map_lidar,
                                std::clamp(off_m, kSurePriorRadius_m, kPriorSearchRadius_m));
  }
  // Those that the last scan left in doubt: one that this scan would not propose is a rival still.
  std::array<PoseHypothesis, kMaxAlternatives> doubted;
  std::transform(result.pose.alternatives.begin(), result.pose.alternatives.end(), doubted.begin(),
                 [&](const Alternative& last) {
                   return PoseHypothesis{last.T_map_base * config.T_base_lidar, 0};
                 });
  verification.consider(std::span(doubted).first(result.pose.alternatives.size()),
                        kPriorSearchRadius_m);
  const Detection& seen = result.detection;
  const auto pairs = place->recognition.from_pairs(seen.breakpoints);
  const std::size_t likely = count_likely(pairs, kLikelyShare);
  verification.consider(pairs.first(likely), kRecognisedRadius_m);
  if (is_thorough && in_doubt(t_ns))
    verification.consider(pairs.subspan(likely), kRecognisedRadius_m);
}

bool Localizer::Workspace::sees_enough(TimeNs t_ns) const {
  return prior_is_fresh(t_ns) || has_full_coverage(points.largest_gap_rad());
}

bool Localizer::Workspace::in_doubt(TimeNs t_ns) const {
  if (!place || place->verification.hypotheses().empty() || !sees_enough(t_ns)) return true;
  const core::VerifiedHypothesis& best = place->verification.hypotheses().front();
  const bool expected = prior_is_fresh(t_ns) && is_expected(best.refined.T_map_lidar, t_ns);
  return !is_conclusive(best.likelihood, expected);
}

/// A bias fits like a motion: walls are where they should be, but not exactly. While the lidar is
/// new and the robot is seen to stand, it is the bias.
bool Localizer::Workspace::may_be_biased() const {
  if (!config.calibrate_online || !place || place->verification.hypotheses().empty()) return false;
  return place->bias.scans() < kTurnsOfANewLidar && memory.is_stationary() &&
         place->verification.hypotheses().front().likelihood.near_hit_share() > kAllButExact;
}

bool Localizer::Workspace::is_exact(TimeNs t_ns) const {
  const auto places = place->verification.hypotheses();
  if (places.empty()) return false;
  const Pose2& T_map_lidar = places.front().refined.T_map_lidar;
  const bool expected = prior_is_fresh(t_ns) && is_expected(T_map_lidar, t_ns);
  const auto likely = place->place_search.places();
  const BeamLikelihood& best = places.front().likelihood;
  const bool moved = place->map_error.is_exact() && is_explained_by_motion();
  return (moved || core::is_exact(best, expected)) &&
         std::any_of(likely.begin(), likely.end(), [&](const VerifiedHypothesis& other) {
           return is_in_map(other) &&
                  same_pose(other.refined.T_map_lidar, T_map_lidar, kJump_m, kJump_rad);
         });
}

void Localizer::Workspace::search_map(TimeNs t_ns) {
  PlaceSearch& search = place->place_search;
  // Where walls have been exact, what does not fit is a motion.
  const double max_map_sigma_m = place->map_error.is_exact() ? BeamModel::kMapSigmas_m.front()
                                                             : BeamModel::kMapSigmas_m.back();
  const std::optional<Prior> prior = memory.prior(t_ns);
  const auto pairs = place->recognition.from_pairs(result.detection.breakpoints);
  const auto begin = [&] {
    search.begin(points, result.detection.segments, result.detection.breakpoints, noise_scale(),
                 max_map_sigma_m, /*fits_motion=*/motion != memory.motion() && !sees_enough(t_ns));
    if (prior) {
      const PoseHypothesis carried_on{prior->T_map_lidar, 0};
      search.consider(std::span(&carried_on, 1));
    }
    search.consider(pairs.first(std::min(pairs.size(), kMaxPairs)));
  };
  begin();
  if (prior_is_fresh(t_ns)) {
    const auto found = search.find();
    if (!found.empty() && is_in_map(found.front()) &&
        is_expected(found.front().refined.T_map_lidar, t_ns)) {
      return;
    }
    begin();
  }
  search.consider(search_everywhere(t_ns));
  for (const core::VerifiedHypothesis& found : search.find()) {
    if (found.log_odds < 0) break;
    const PoseHypothesis there{found.refined.T_map_lidar, 0};
    place->verification.consider(std::span(&there, 1), kRecognisedRadius_m);
  }
}

std::optional<double> Localizer::log_odds_of_map() {
  Workspace& w = *workspace_;
  if (!w.place) return std::nullopt;
  PlaceSearch& search = w.place->place_search;
  search.begin(w.points, w.result.detection.segments, w.result.detection.breakpoints,
               w.noise_scale(), BeamModel::kMapSigmas_m.back(), /*fits_motion=*/false);
  const auto consider = [&](const Pose2& T_map_base) {
    const PoseHypothesis there{T_map_base * w.config.T_base_lidar, 0};
    search.consider(std::span(&there, 1));
  };
  const PoseEstimate& pose = w.result.pose;
  if (has_pose(pose.state)) consider(pose.T_map_base);
  for (const Alternative& alternative : pose.alternatives) consider(alternative.T_map_base);
  const auto found = search.find();
  if (found.empty()) return std::nullopt;
  return found.front().log_odds;
}

bool Localizer::is_searching() const {
  return workspace_->place && workspace_->place->map_search.is_running();
}

std::span<const PoseHypothesis> Localizer::Workspace::search_everywhere(TimeNs t_ns) {
  MapSearch& search = place->map_search;
  if (!search.is_running() || to_seconds(t_ns - searched_ns) > kMaxSearchPause_s) {
    search.begin(points.points(), result.detection.segments);
    searched_ns = t_ns;
    turned_rad = 0;
  } else if (t_ns != searched_ns) {
    turned_rad += rotation.rate_rad_s().value_or(0) * to_seconds(t_ns - searched_ns);
    searched_ns = t_ns;
  }
  search.advance(config.search_nodes_per_scan);
  everywhere.assign(search.found().begin(), search.found().end());
  for (PoseHypothesis& found : everywhere) {
    found.T_map_lidar.theta_rad = normalize_angle(found.T_map_lidar.theta_rad + turned_rad);
  }
  return everywhere;
}

}  // namespace cornerd::core
