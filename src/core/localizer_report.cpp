// SPDX-License-Identifier: MIT
// From what was decided to what is told of it.
#include <algorithm>
#include <cmath>

#include "core/geometry/squared.hpp"
#include "core/localizer_workspace.hpp"

namespace cornerd::core {
namespace {

/// A scan without a wider gap than this has seen all around.
constexpr double kSeesAround_rad = radians(90);
/// Scans in which a lidar's bias is learned.
constexpr std::size_t kScansOfANewLidar = 20;
/// Residuals this much beyond the scan's own noise are smeared by a motion.
constexpr double kSmearedSpread = 1.4;

Covariance3 doubt_of(double place_m, double heading_rad) {
  return Eigen::Vector3d(squared(place_m), squared(place_m), squared(heading_rad)).asDiagonal();
}

/// A motion that is not known moves walls against each other, and so do walls that are not where
/// the map has them: told once, by what says more. A radian counts as a metre.
Covariance3 larger(const Covariance3& one, const Covariance3& other) {
  return one.trace() > other.trace() ? one : other;
}

/// What a bias of 1 % and 5 mm that is not learnt yet does to poses in rooms of a metre or two.
Covariance3 doubt_of_bias() { return doubt_of(0.006, radians(0.15)); }

/// Residuals beyond the noise are no noise that many points average out: a motion that is not known
/// moves them together, and the pose with them. More so where the pose rests on the last one, as
/// such a scan showed too little to tell by itself. The shares are those of robots that start and
/// turn at once, simulated in flat-7 without odometry, with a bias of 1 % and 5 mm and without: the
/// NEES of `tracking` scans, by how smeared they are, is 1 to 6 in five drives (up to 195 without).
Covariance3 doubt_of_smear(const RefinedPose& refined, PoseState state) {
  const double smear_m = refined.rmse_m * std::sqrt(1 - 1 / refined.spread);
  return state == PoseState::kTracking ? doubt_of(smear_m, 1.2 * smear_m)
                                       : doubt_of(smear_m / 2, 0.2 * smear_m);
}

}  // namespace

void Localizer::Workspace::report(const Decision& decision, std::size_t corners, TimeNs t_ns) {
  PoseEstimate& pose = result.pose;
  pose.state = decision.state;
  pose.t_ns = t_ns;
  pose.room.reset();
  pose.corners = 0;
  pose.inliers = 0;
  pose.rmse_m = 0;
  pose.alternatives.clear();
  pose.covariance.setZero();
  pose.T_map_base = {};
  pose.p_wrong = decision.doubt;
  filter = filtered;
  if (!has_pose(decision.state)) named_in_a_row = 0;
  if (has_pose(decision.state)) {
    report_pose(chosen(decision), corners, t_ns);
  } else if (decision.state == PoseState::kAmbiguous) {
    report_alternatives(candidates.first(decision.rivals));
  }
  if (pose.state == PoseState::kLost || pose.state == PoseState::kAmbiguous) {
    const auto predicted = odometer.prediction();
    if (predicted && !contradicts(*predicted) && !may_set_out()) predict(*predicted, result.pose);
  }
  pose.age_s = memory.age_s(t_ns);
  result.odometry = odometer.summary();
}

bool Localizer::Workspace::contradicts(const PredictedPose& predicted) const {
  if (result.pose.state == PoseState::kLost) {
    return T_map_doubted &&
           !same_pose(predicted.T_map_base, *T_map_doubted * T_lidar_base, kJump_m, kJump_rad);
  }
  const auto is_near = [&](const Alternative& other) {
    return same_pose(predicted.T_map_base, other.T_map_base, kJump_m, kJump_rad);
  };
  return std::none_of(result.pose.alternatives.begin(), result.pose.alternatives.end(), is_near);
}

/// A scan that sees all around and shows no place was most likely taken in motion, of which
/// readings that are late or missing may not tell.
bool Localizer::Workspace::may_set_out() const {
  return odometer.may_miss_motion() && points.largest_gap_rad() < kSeesAround_rad;
}

void Localizer::Workspace::predict(const PredictedPose& predicted, PoseEstimate& pose) const {
  pose.state = PoseState::kPredicted;
  pose.alternatives.clear();
  pose.T_map_base = predicted.T_map_base;
  pose.covariance = predicted.covariance;
  if (map) pose.room = map->room_at(pose.T_map_base.translation());
}

void Localizer::Workspace::report_pose(const core::VerifiedHypothesis& found, std::size_t corners,
                                       TimeNs t_ns) {
  const RefinedPose refined = refined_by_walls(found, t_ns);
  const Pose2& T_map_lidar = refined.T_map_lidar;
  PoseEstimate& pose = result.pose;
  pose.T_map_base = T_map_lidar * T_lidar_base;
  const bool is_first = !memory.prior(t_ns);
  const bool is_off = refined.map_sigma_m > 0;
  // In an exact map the difference of two poses is the velocity.
  memory.update(T_map_lidar, t_ns, motion.twist, is_off ? refined.covariance : Covariance3::Zero());
  pose.state == PoseState::kFix ? filter.confirm(T_map_lidar) : filter.follow(T_map_lidar);
  place->map_error.add(refined.face_residuals);
  const Covariance3 of_lidar =
      refined.covariance + larger(is_off ? Covariance3::Zero()
                                         : place->map_error.pose_covariance(refined.face_residuals),
                                  odometer.has_motion() ? odometer.deskew_covariance()
                                                        : deskew_covariance(T_map_lidar, is_first));
  pose.covariance = covariance_of_base(of_lidar, T_map_lidar, pose.T_map_base);
  if (refined.spread > kSmearedSpread && !trusts_odometry()) {
    pose.covariance += doubt_of_smear(refined, pose.state);
    if (place->bias.scans() < kScansOfANewLidar) pose.covariance += doubt_of_bias();
  }
  odometer.correct(pose.T_map_base, pose.covariance);
  pose.room = map->room_at(pose.T_map_base.translation());
  pose.corners = corners;
  pose.inliers = found.rays.hits;
  pose.rmse_m = refined.rmse_m;
}

void Localizer::Workspace::report_alternatives(std::span<const core::VerifiedHypothesis> rivals) {
  const std::size_t count = std::min(rivals.size(), kMaxAlternatives);
  alternatives_are_all = place->place_search.is_complete();
  double sum = 0;
  const auto belief = [&](std::size_t i) {
    return std::exp(rivals[i].log_odds - rivals.front().log_odds);
  };
  for (std::size_t i = 0; i < count; ++i) sum += belief(i);
  for (std::size_t i = 0; i < count; ++i) {
    result.pose.alternatives.push_back(
        {rivals[i].refined.T_map_lidar * T_lidar_base, belief(i) / sum});
  }
}

}  // namespace cornerd::core
