// SPDX-License-Identifier: MIT
#include "survey/adjustment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/linear_solve.hpp"
#include "survey/linearization.hpp"

namespace cornerd::survey {
namespace {

constexpr int kMaxSteps = 15;
/// The first steps let what is far off right_hand_side as well: walls that were mapped twice and
/// are one now bring the poses together. From step to step that is less.
constexpr double kFirstGncScale = 256;
constexpr double kGncDecay = 0.25;
/// Largest step of a pose at convergence.
constexpr double kConverged_m = 2e-6;

/// Returns the largest translation of a pose.
double apply(const Linearization& equations, const Eigen::VectorXd& move, MappedDrive& drive) {
  double largest_m = 0;
  for (std::size_t scan = 1; scan < drive.T_map_lidar.size(); ++scan) {
    const Eigen::Vector3d step = move.segment<3>(equations.pose_unknown(scan));
    core::Pose2& pose = drive.T_map_lidar[scan];
    pose = {pose.x_m + step.x(), pose.y_m + step.y(),
            core::normalize_angle(pose.theta_rad + step.z())};
    largest_m = std::max(largest_m, step.head<2>().norm());
  }
  for (std::size_t i = 0; i < drive.faces.size(); ++i) {
    const Eigen::Vector2d step = move.segment<2>(equations.face_unknown(i));
    LineLandmark& face = drive.faces[i];
    face.set_line(face.normal_rad() + step[0], face.offset_m() + step[1]);
  }
  return largest_m;
}

}  // namespace

AdjustmentResult adjust(MappedDrive& drive, std::span<const FaceConstraint> constraints) {
  if (drive.T_map_lidar.size() < 2) return {};
  AdjustmentResult result;
  for (result.steps = 1; result.steps <= kMaxSteps; ++result.steps) {
    const double gnc_scale = std::max(1.0, kFirstGncScale * std::pow(kGncDecay, result.steps - 1));
    const Linearization now(drive, constraints, gnc_scale);
    const Eigen::VectorXd move = now.equations().solve(now.equations().right_hand_side());
    const bool still =
        move.size() == 0 || (apply(now, move, drive) < kConverged_m && gnc_scale <= 1);
    if (!still && result.steps < kMaxSteps) continue;
    result.outliers = now.outliers();
    if (!drive.observations.empty()) {
      result.sigma =
          std::sqrt(now.chi_square() / static_cast<double>(2 * drive.observations.size()));
    }
    for (std::size_t i = 0; i < drive.faces.size(); ++i) {
      const Eigen::Matrix2d& information = now.information_of(i);
      if (core::determinant(information) > 0)
        drive.faces[i].set_covariance(core::inverse(information));
    }
    break;
  }
  return result;
}

core::Covariance3 relative_pose_covariance(const MappedDrive& drive, std::size_t from,
                                           std::size_t to) {
  const Linearization now(drive, {}, /*gnc_scale=*/1);
  const RelativePoseResidual residual(drive.T_map_lidar[from], drive.T_map_lidar[to], {});
  const std::array<int, 6> unknowns = now.unknowns_of(from, to);
  Eigen::MatrixXd jacobians = Eigen::MatrixXd::Zero(now.equations().right_hand_side().size(), 3);
  for (int row = 0; row < 3; ++row) {
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      if (unknowns[i] >= 0)
        jacobians(unknowns[i], row) = residual.jacobian[static_cast<std::size_t>(row)][i];
    }
  }
  const Eigen::MatrixXd spread = now.equations().solve(jacobians);
  if (spread.size() == 0) return core::Covariance3::Zero();
  return jacobians.transpose() * spread;
}

std::vector<double> rotation_variances(const MappedDrive& drive, std::uint32_t from,
                                       std::span<const std::uint32_t> to) {
  // Right-hand sides per solve, to bound memory.
  constexpr std::size_t kAtOnce = 64;
  std::vector<double> variances(to.size(), std::numeric_limits<double>::infinity());
  const Linearization now(drive, {}, /*gnc_scale=*/1);
  for (std::size_t first = 0; first < to.size(); first += kAtOnce) {
    const auto some = to.subspan(first, std::min(kAtOnce, to.size() - first));
    Eigen::MatrixXd jacobians = Eigen::MatrixXd::Zero(now.equations().right_hand_side().size(),
                                                      static_cast<Eigen::Index>(some.size()));
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      jacobians(now.face_unknown(from), column) -= 1;
      jacobians(now.face_unknown(some[i]), column) += 1;
    }
    const Eigen::MatrixXd spread = now.equations().solve(jacobians);
    if (spread.size() == 0) return variances;
    for (std::size_t i = 0; i < some.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      variances[first + i] = jacobians.col(column).dot(spread.col(column));
    }
  }
  return variances;
}

}  // namespace cornerd::survey
