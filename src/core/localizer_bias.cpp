// SPDX-License-Identifier: MIT
// What is learned of the lidar.
#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// The lidar's bias is learnt from turns that the map explains nearly whole, of a robot that
/// stands or whose wheels tell how it moves: what is steady in a motion passes for no bias, but
/// what changes would.
constexpr double kTeachingShare = 0.8;

/// Scans that do not teach are tried without the learned bias, one in so many; it is forgotten
/// where so many in a row have more hits by this share of the rays.
constexpr std::uint64_t kScansPerTrialOfBias = 8;
constexpr std::size_t kTrialsAgainstBias = 5;
constexpr double kShareAgainstBias = 0.1;

}  // namespace

void Localizer::forget_lidar() {
  workspace_->detector.forget();
  if (!workspace_->place) return;
  workspace_->place->bias.forget();
  workspace_->place->map_error.forget();
}

EstimatedBias Localizer::estimated_bias() const {
  if (workspace_->place) return workspace_->place->bias.estimate();
  return {.bias = workspace_->config.bias, .sigma = {}};
}

void Localizer::resume(const EstimatedBias& learned) {
  if (workspace_->place) workspace_->place->bias.resume(learned);
}

bool Localizer::Workspace::teaches(const Decision& decision) const {
  // Of walls that are off by centimetres a bias would be learnt that the lidar has not.
  if (!config.calibrate_online || !has_pose(decision.state) || is_map_inexact()) return false;
  const core::VerifiedHypothesis& at = chosen(decision);
  return at.map_sigma_m == 0 && (memory.is_stationary() || odometer.has_motion()) &&
         at.likelihood.near_hit_share() > kTeachingShare;
}

/// What was learned of another lidar, or in a map of another scale, would never be unlearned: no
/// scan with it fits, and none would teach.
void Localizer::Workspace::doubt_bias(const Scan& scan, const Decision& decision, TimeNs t_ns) {
  if (!config.calibrate_online || place->bias.scans() == 0 || !has_pose(decision.state) ||
      result.pose.seq % kScansPerTrialOfBias != 0) {
    return;
  }
  const Pose2& T_map_lidar = chosen(decision).refined.T_map_lidar;
  const auto with = try_at(scan, t_ns, motion, T_map_lidar, place->bias.bias());
  const auto without = try_at(scan, t_ns, motion, T_map_lidar, config.bias);
  const auto margin =
      static_cast<std::size_t>(kShareAgainstBias * static_cast<double>(points.size()));
  scans_against_bias = without.hits > with.hits + margin ? scans_against_bias + 1 : 0;
  if (scans_against_bias < kTrialsAgainstBias) return;
  place->bias.forget();
  scans_against_bias = 0;
}

}  // namespace cornerd::core
