// SPDX-License-Identifier: MIT
// What is believed of a decision, by what was known before the scan.
#include <cmath>

#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// A prior that may be off by more than this says little about what half a scan shows.
constexpr double kFresh_m = 0.2;
constexpr double kFresh_rad = radians(15);
/// What is left of a scan while a lidar is being covered is believed near a prior that is almost
/// sure, and is misread where it is farther from it than this beyond what that may be off by.
constexpr double kAlmostSure_rad = radians(5);
constexpr double kAtPrior_m = 0.03;
constexpr double kAtPrior_rad = radians(3);

/// Two walls and a box stand like a corner: with half of the view, most hits prove little.
constexpr double kMaxGap_rad = radians(170);
/// Corners of a place that is certain.
constexpr std::size_t kCertainCorners = 2;

}  // namespace

bool Localizer::Workspace::sees_all_around() const {
  return points.largest_gap_rad() < kMaxGap_rad;
}

bool Localizer::Workspace::is_expected(const Pose2& T_map_lidar, TimeNs t_ns) const {
  const std::optional<Prior> prior = memory.prior(t_ns);
  return prior && same_pose(prior->T_map_lidar, T_map_lidar, kJump_m, kJump_rad);
}

bool Localizer::Workspace::prior_is_fresh(TimeNs t_ns) const {
  const std::optional<Prior> prior = memory.prior(t_ns);
  return prior && prior->position_error_m < kFresh_m && prior->heading_error_rad < kFresh_rad;
}

bool Localizer::Workspace::is_at_prior(const Pose2& T_map_lidar, TimeNs t_ns) const {
  const std::optional<Prior> prior = memory.prior(t_ns);
  return prior && prior->heading_error_rad < kAlmostSure_rad &&
         prior->position_error_m < kFresh_m &&
         same_pose(prior->T_map_lidar, T_map_lidar, prior->position_error_m + kAtPrior_m,
                   prior->heading_error_rad + kAtPrior_rad);
}

PoseState Localizer::Workspace::believe(const Decision& decision, std::size_t corners,
                                        TimeNs t_ns) {
  const Pose2& T_map_lidar = chosen(decision).refined.T_map_lidar;
  if (!is_conclusive(chosen(decision), t_ns) && odometer.dead_reckoning() &&
      !is_expected(T_map_lidar, t_ns) &&
      chosen(decision).log_odds < PlaceFilter::kLogOddsAgainstCarried - std::log(kWrongFixRate)) {
    T_map_doubted.reset();
    return PoseState::kLost;
  }
  const bool all_around = sees_all_around();
  if (decision.state == PoseState::kTracking) {
    return all_around || (corners >= 1 && is_at_prior(T_map_lidar, t_ns)) ? PoseState::kTracking
                                                                          : PoseState::kLost;
  }
  const bool confirmed =
      T_map_doubted && same_pose(*T_map_doubted, T_map_lidar, kJump_m, kJump_rad);
  T_map_doubted.reset();
  const bool is_certain = all_around && chosen(decision).rays.is_conclusive(/*expected=*/false) &&
                          corners >= kCertainCorners;
  // What is left of the view of a lidar that is being covered shows two walls and no more.
  const bool is_covered = saw_all_around && !all_around;
  saw_all_around = saw_all_around || all_around;
  if (confirmed || is_certain || is_expected(T_map_lidar, t_ns) ||
      !(memory.prior(t_ns) || is_covered)) {
    return decision.state;
  }
  T_map_doubted = T_map_lidar;
  return PoseState::kLost;
}

}  // namespace cornerd::core
