// SPDX-License-Identifier: MIT
// What is learned of the lidar.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// The lidar's bias is learnt from scans that the map explains nearly whole, of a robot that
/// stands or whose wheels tell how it moves: what is steady in a motion passes for no bias, but
/// what changes would.
constexpr double kTeachingShare = 0.8;

/// A robot that sets out is faster after one scan; the poses of one that stands, of a lidar whose
/// bias is not known yet, seem to move by less.
constexpr double kSetsOut_m_s = 0.3;
constexpr double kSetsOut_rad_s = 0.15;

/// A stored bias is tried against none in one scan of so many. So many in a row for one of both
/// decide: by so many nats per ray against it, by none for it.
constexpr std::uint64_t kScansPerTrial = 8;
constexpr int kTrials = 5;
constexpr double kNatsPerRay = 0.1;

}  // namespace

void Localizer::forget_lidar() {
  workspace_->detector.forget();
  workspace_->of_last_scan.reset();
  if (!workspace_->place) return;
  workspace_->place->bias.forget();
  workspace_->place->map_error.forget();
}

EstimatedBias Localizer::estimated_bias() const {
  if (workspace_->place) return workspace_->place->bias.estimate();
  return {.bias = workspace_->config.bias, .sigma = {}};
}

void Localizer::resume(const EstimatedBias& learned) {
  if (!workspace_->place) return;
  workspace_->of_last_scan.reset();
  workspace_->place->bias.resume(learned);
  workspace_->doubts_bias = learned.scans > 0;
  workspace_->trials_of_bias = 0;
}

bool Localizer::Workspace::teaches(const Decision& decision) const {
  // Of walls that are off by centimetres a bias would be learnt that the lidar has not.
  if (!config.calibrate_online || !has_pose(decision.state) || is_map_inexact()) return false;
  const core::VerifiedHypothesis& at = chosen(decision);
  return (memory.is_stationary() || odometer.has_motion()) &&
         at.rays.near_hit_share() > kTeachingShare;
}

/// Whether a robot stood during a scan the next one shows: one that sets out passes for a bias. A
/// next scan that is lost shows nothing, and is what a bias that is not known yet leads to.
void Localizer::Workspace::learn_bias(const Scan& scan, const Decision& decision, TimeNs t_ns) {
  if (!place) return;
  const bool teaches_now = teaches(decision);
  const Twist2 since = memory.motion();
  const bool set_out = has_pose(decision.state) && (since.speed_m_s() > kSetsOut_m_s ||
                                                    std::abs(since.omega_rad_s) > kSetsOut_rad_s);
  if (of_last_scan && !set_out && !odometer.has_motion()) place->bias.update(*of_last_scan);
  of_last_scan.reset();
  if (!teaches_now) return;
  const VerifiedHypothesis& at = chosen(decision);
  const auto evidence = place->bias.evidence(*map, at.refined.T_map_lidar, points.points(),
                                             std::max(1.0, result.detection.noise_scale));
  // Walls seem off: they are exact where four numbers explain all of them, offsets and all.
  if (evidence && at.map_sigma_m > 0) {
    const VerifiedHypothesis biased =
        try_at(scan, t_ns, motion, at.refined.T_map_lidar, place->bias.bias_by(*evidence));
    if (!biased.rays.is_conclusive(/*expected=*/true) ||
        biased.refined.face_residuals.shows_offsets()) {
      return;
    }
  }
  if (!odometer.has_motion()) {
    of_last_scan = evidence;
  } else if (evidence) {
    place->bias.update(*evidence);
  }
}

/// What was learned of another lidar, or in a map of another scale, would never be unlearned: its
/// many scans outweigh those to come, or none of them fits and teaches.
void Localizer::Workspace::try_bias(const Scan& scan, const Decision& decision, TimeNs t_ns) {
  if (!doubts_bias || !place || result.pose.seq % kScansPerTrial != 0) return;
  double with = 0;
  double without = 0;
  if (has_pose(decision.state)) {
    const Pose2& T_map_lidar = chosen(decision).refined.T_map_lidar;
    with = try_at(scan, t_ns, motion, T_map_lidar, place->bias.bias()).rays.log_likelihood;
    // What a bias leaves of the residuals passes for a motion.
    without = try_at(scan, t_ns, memory.motion(), T_map_lidar, config.bias).rays.log_likelihood;
  }
  const double margin = kNatsPerRay * static_cast<double>(points.size());
  const bool is_against = !has_pose(decision.state) || without > with + margin;
  const bool is_for = has_pose(decision.state) && with >= without;
  trials_of_bias =
      is_against ? std::max(trials_of_bias, 0) + 1 : (is_for ? std::min(trials_of_bias, 0) - 1 : 0);
  if (trials_of_bias == kTrials) place->bias.forget();
  doubts_bias = std::abs(trials_of_bias) < kTrials;
}

}  // namespace cornerd::core
