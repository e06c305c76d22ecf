// SPDX-License-Identifier: MIT
// From a scan to the places where it may have been taken.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// A prior is off by what it says, within what a robot drives from scan to scan.
constexpr double kPriorSearchRadius_m = 0.15;
constexpr double kSurePriorRadius_m = 0.03;
/// What a prior's heading is off by counts at walls that are so far away.
constexpr double kReach_m = 3;

/// Places with fewer votes of corners than this share of the best one's are looked at where those
/// with more leave doubt: in large buildings they are many.
constexpr double kLikelyShare = 0.7;

/// A search that did not go on for longer is of another scan.
constexpr double kMaxSearchPause_s = 1;

}  // namespace

void Localizer::Workspace::look(const Scan& scan, TimeNs t_ns, const ScanMotion& as_if_moving) {
  // The returns in the order of their bearing, as a lidar that stood still would have seen them.
  motion = as_if_moving;
  points.assign(scan, config.min_range_m, config.max_range_m, t_ns, motion,
                place ? place->bias.bias() : config.bias);

  // Walls, and the corners and ends of walls between them (ALTBD).
  detector.detect(points, result.detection);
  if (!place) return;

  // The place where the robot should be by now, and those that pairs of corners point to.
  PlaceSearch& search = place->place_search;
  const std::optional<Prior> prior = memory.prior(t_ns);
  // Where walls have been exact, what does not fit is a motion.
  search.begin(points, result.detection.segments, result.detection.breakpoints,
               {.noise_scale = noise_scale(),
                .max_map_sigma_m = place->map_error.is_exact() ? BeamModel::kMapSigmas_m.front()
                                                               : BeamModel::kMapSigmas_m.back(),
                .fits_motion = motion != memory.motion() && !sees_enough(t_ns),
                .prior = prior_is_fresh(t_ns) ? prior : std::nullopt});
  if (prior) {
    const double off_m = prior->position_error_m + kReach_m * prior->heading_error_rad;
    search.consider_prior(prior->T_map_lidar,
                          std::clamp(off_m, kSurePriorRadius_m, kPriorSearchRadius_m));
  }
  // Those that the last scan left in doubt: one that this scan would not propose is a rival still.
  // A part of many would take the room of those that were left out.
  std::array<PoseHypothesis, kMaxAlternatives> doubted;
  std::transform(result.pose.alternatives.begin(), result.pose.alternatives.end(), doubted.begin(),
                 [&](const Alternative& last) {
                   return PoseHypothesis{last.T_map_base * config.T_base_lidar, 0};
                 });
  const std::size_t doubts = alternatives_are_all ? result.pose.alternatives.size() : 0;
  search.consider(std::span(doubted).first(doubts), /*are_sure=*/true);
  pairs = place->recognition.from_pairs(result.detection.breakpoints);
  search.consider(pairs.first(count_likely(pairs, kLikelyShare)));
  search.find();
}

bool Localizer::Workspace::sees_enough(TimeNs t_ns) const {
  return prior_is_fresh(t_ns) || sees_all_around();
}

bool Localizer::Workspace::is_conclusive(const VerifiedHypothesis& found, TimeNs t_ns) const {
  const bool expected = prior_is_fresh(t_ns) && is_expected(found.refined.T_map_lidar, t_ns);
  return sees_enough(t_ns) && found.is_exact && found.rays.is_conclusive(expected);
}

bool Localizer::Workspace::is_conclusive(TimeNs t_ns) const {
  if (!place || place->place_search.places().empty()) return false;
  return is_conclusive(place->place_search.places().front(), t_ns);
}

void Localizer::Workspace::search_map(TimeNs t_ns) {
  PlaceSearch& search = place->place_search;
  const auto found = search.places();
  if (prior_is_fresh(t_ns) && !found.empty() && is_in_map(found.front()) &&
      is_expected(found.front().refined.T_map_lidar, t_ns)) {
    return;
  }
  if (sees_enough(t_ns) && !found.empty() && found.front().log_odds > -2 * std::log(kWrongFixRate))
    return;
  search.consider(search_everywhere(t_ns));
  search.consider(pairs.subspan(count_likely(pairs, kLikelyShare)));
  search.find();
}

std::optional<double> Localizer::log_odds_of_map() {
  Workspace& w = *workspace_;
  if (!w.place) return std::nullopt;
  PlaceSearch& search = w.place->place_search;
  search.begin(w.points, w.result.detection.segments, w.result.detection.breakpoints,
               {.noise_scale = w.noise_scale()});
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
