// SPDX-License-Identifier: MIT
// Poses of partial scans.
#include <limits>

#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// Shorter, and two poses tell nothing of the motion between them.
constexpr double kLeastTimeOfAMotion_s = 0.02;

/// Wheels tell the way itself; how unevenly it was driven is as if a motion were so much of the
/// time old (the NEES of quarters of scans, drives in a flat that stop and turn often).
constexpr double kUnevenAge = 0.15;

}  // namespace

const PoseEstimate* Localizer::follow(const Sample& sample) {
  Workspace& w = *workspace_;
  if (!w.place || !w.place->parts || !w.place->parts->add(sample)) return nullptr;
  PartialScanTracker& parts = *w.place->parts;
  const std::optional<PredictedState> expected = w.expectation(parts.end_ns());
  if (!expected) return nullptr;
  const auto found = parts.localize(*expected, w.place->bias.bias(), w.noise_scale());
  if (!found) return nullptr;
  const Pose2& T_map_lidar = found->refined.T_map_lidar;
  PoseEstimate& pose = w.between;
  pose.seq = ++w.result.pose.seq;
  pose.t_ns = parts.end_ns();
  pose.state = PoseState::kTracking;
  pose.T_map_base = T_map_lidar * w.T_lidar_base;
  const Covariance3 of_lidar =
      found->refined.covariance +
      w.place->map_error.pose_covariance(found->refined.face_residuals) +
      outdated_motion_covariance(expected->motion_age_s, parts.duration_s());
  pose.covariance = covariance_of_base(of_lidar, T_map_lidar, pose.T_map_base);
  pose.room = w.map->room_at(pose.T_map_base.translation());
  pose.corners =
      static_cast<std::size_t>(w.place->recognition.recognised(parts.breakpoints(), T_map_lidar));
  pose.inliers = found->rays.hits;
  pose.rmse_m = found->refined.rmse_m;
  pose.age_s = w.memory.age_s(pose.t_ns);
  pose.p_wrong = std::numeric_limits<double>::quiet_NaN();
  return &pose;
}

/// By odometry where there is a prediction; else the last scans' velocity is constant.
std::optional<PredictedState> Localizer::Workspace::expectation(TimeNs t_ns) {
  if (!has_pose(result.pose.state)) return std::nullopt;
  const auto ahead = odometer.predict_latest();
  const auto behind = odometer.prediction();
  if (ahead && behind && to_seconds(ahead->t_ns - behind->t_ns) > kLeastTimeOfAMotion_s) {
    const Pose2 T_map_ahead = ahead->T_map_base * config.T_base_lidar;
    const Twist2 steady = motion_between(behind->T_map_base * config.T_base_lidar, T_map_ahead,
                                         to_seconds(ahead->t_ns - behind->t_ns));
    return PredictedState{T_map_ahead * steady.over(to_seconds(t_ns - ahead->t_ns)),
                          covariance_of_base(ahead->covariance, ahead->T_map_base, T_map_ahead),
                          steady, kUnevenAge * to_seconds(ahead->t_ns - behind->t_ns)};
  }
  const std::optional<Prior> prior = memory.prior(t_ns);
  if (!prior || odometer.has_motion()) return std::nullopt;
  const Covariance3 of_lidar = covariance_of_base(result.pose.covariance, result.pose.T_map_base,
                                                  result.pose.T_map_base * config.T_base_lidar);
  const double age_s = to_seconds(t_ns - result.pose.t_ns);
  return PredictedState{prior->T_map_lidar, extrapolated_covariance(of_lidar, age_s),
                        memory.motion(), age_s};
}

}  // namespace cornerd::core
