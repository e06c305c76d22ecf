// SPDX-License-Identifier: MIT
#include "replay/pose_error.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/linear_solve.hpp"

namespace cornerd::replay {

PoseError error_of(const core::Pose2& T_map_base, const core::Pose2& truth) {
  return {(T_map_base.translation() - truth.translation()).norm(),
          std::abs(core::angle_between(truth.theta_rad, T_map_base.theta_rad))};
}

bool is_right(const core::Pose2& T_map_base, const core::Pose2& truth) {
  const PoseError error = error_of(T_map_base, truth);
  return error.position_m <= kWrong_m && error.heading_rad <= kWrong_rad;
}

bool lists_truth(const core::PoseEstimate& estimate, const core::Pose2& truth) {
  return std::any_of(
      estimate.alternatives.begin(), estimate.alternatives.end(),
      [&](const core::Alternative& other) { return is_right(other.T_map_base, truth); });
}

std::optional<double> normalised_error_squared(const core::PoseEstimate& estimate,
                                               const core::Pose2& truth) {
  const core::Cholesky3 root(estimate.covariance);
  if (!root.succeeded()) return std::nullopt;
  const core::Pose2& pose = estimate.T_map_base;
  const Eigen::Vector3d error(pose.x_m - truth.x_m, pose.y_m - truth.y_m,
                              core::angle_between(truth.theta_rad, pose.theta_rad));
  return error.dot(root.solve(error));
}

}  // namespace cornerd::replay
