// SPDX-License-Identifier: MIT
#include "survey/linearization.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::survey {
namespace {

/// Chi-square (two degrees of freedom) at which an observation counts half.
constexpr double kHalfWeight = 9;
/// The same for an odometry edge (three degrees of freedom): a wheel slip.
constexpr double kHalfWeightEdge = 9;
/// The same for a loop constraint.
constexpr double kHalfWeightLoop = 9;

/// Damping of all unknowns; keeps unobservable ones at their value.
constexpr double kDamping = 1e-3;

}  // namespace

RelativePoseResidual::RelativePoseResidual(const core::Pose2& from, const core::Pose2& to,
                                           const core::Pose2& expected) {
  const core::Pose2 relative = from.inverse() * to;
  const double c = std::cos(from.theta_rad);
  const double s = std::sin(from.theta_rad);
  off = {relative.x_m - expected.x_m, relative.y_m - expected.y_m,
         core::angle_between(expected.theta_rad, relative.theta_rad)};
  jacobian = {
      {{-c, -s, relative.y_m, c, s, 0}, {s, -c, -relative.x_m, -s, c, 0}, {0, 0, -1, 0, 0, 1}}};
}

Linearization::Linearization(const MappedDrive& drive, std::span<const FaceConstraint> constraints,
                             double gnc_scale)
    : drive_(drive),
      gnc_scale_(gnc_scale),
      first_face_(3 * (static_cast<int>(drive.T_map_lidar.size()) - 1)),
      equations_(face_unknown(drive.faces.size())),
      information_(drive.faces.size(), Eigen::Matrix2d::Zero()) {
  for (const MatchedObservation& observation : drive_.observations) add(observation);
  for (std::size_t scan = 1; scan < drive_.odometry_edges.size(); ++scan) add_odometry_edge(scan);
  for (const LoopConstraint& constraint : drive_.loop_constraints) add_loop_constraint(constraint);
  for (const FaceConstraint& constraint : constraints) add_face_constraint(constraint);
  equations_.add_damping(kDamping);
}

void Linearization::add(const MatchedObservation& observation) {
  const core::Pose2& T_map_lidar = drive_.T_map_lidar[observation.scan];
  const LineLandmark& face = drive_.faces[observation.face];
  const LineObservation& seen = observation.seen;
  const core::Vec2 arm = T_map_lidar * seen.centroid - T_map_lidar.translation();
  const core::Vec2 centroid = T_map_lidar.translation() + arm;
  const double angle_rad =
      core::angle_between(face.normal_rad(), seen.normal_rad + T_map_lidar.theta_rad);
  const double height_m = face.height_of(centroid);
  const double angle_weight = 1 / (seen.sigma_angle_rad * seen.sigma_angle_rad);
  const double height_weight = 1 / (seen.sigma_offset_m * seen.sigma_offset_m);
  const double chi2 = angle_rad * angle_rad * angle_weight + height_m * height_m * height_weight;
  const double weight = 1 / (1 + chi2 / (kHalfWeight * gnc_scale_));
  chi_square_ += std::min(chi2, kHalfWeight);
  if (chi2 > kHalfWeight) ++outliers_;

  const int pose = pose_unknown(observation.scan);
  const int line = face_unknown(observation.face);
  equations_.add<2>({or_fixed(pose, 2), line}, {1, -1}, angle_rad, weight * angle_weight);
  const core::Vec2& normal = face.normal();
  const double along_m = face.along_of(centroid);
  equations_.add<5>({or_fixed(pose, 0), or_fixed(pose, 1), or_fixed(pose, 2), line, line + 1},
                    {normal.x(), normal.y(), normal.dot(core::rotate_left(arm)), -along_m, -1},
                    height_m, weight * height_weight);

  Eigen::Matrix2d& known = information_[observation.face];
  const Eigen::Vector2d jacobian(along_m, 1);
  known += weight * height_weight * jacobian * jacobian.transpose();
  known(0, 0) += weight * angle_weight;
}

void Linearization::add_odometry_edge(std::size_t scan) {
  const OdometryEdge& link = drive_.odometry_edges[scan];
  add_relative_pose(scan - 1, scan, link.T_before_now, link.covariance.diagonal(), kHalfWeightEdge);
}

void Linearization::add_loop_constraint(const LoopConstraint& constraint) {
  const Eigen::Vector3d sigma(constraint.sigma_m, constraint.sigma_m, constraint.sigma_rad);
  add_relative_pose(constraint.earlier, constraint.later, constraint.T_earlier_later,
                    sigma.cwiseAbs2(), kHalfWeightLoop * gnc_scale_);
}

void Linearization::add_relative_pose(std::size_t from, std::size_t to, const core::Pose2& expected,
                                      const Eigen::Vector3d& variance, double half) {
  const RelativePoseResidual residual(drive_.T_map_lidar[from], drive_.T_map_lidar[to], expected);
  double chi2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    chi2 += residual.off[i] * residual.off[i] / variance[static_cast<int>(i)];
  }
  const double weight = 1 / (1 + chi2 / half);
  const std::array<int, 6> unknowns = unknowns_of(from, to);
  for (std::size_t i = 0; i < 3; ++i) {
    equations_.add<6>(unknowns, residual.jacobian[i], residual.off[i],
                      weight / variance[static_cast<int>(i)]);
  }
}

std::array<int, 6> Linearization::unknowns_of(std::size_t from, std::size_t to) const {
  const int a = pose_unknown(from);
  const int b = pose_unknown(to);
  return {or_fixed(a, 0), or_fixed(a, 1), or_fixed(a, 2),
          or_fixed(b, 0), or_fixed(b, 1), or_fixed(b, 2)};
}

void Linearization::add_face_constraint(const FaceConstraint& constraint) {
  const LineLandmark& one = drive_.faces[constraint.one];
  const LineLandmark& other = drive_.faces[constraint.other];
  const int a = face_unknown(constraint.one);
  const int b = face_unknown(constraint.other);
  const double rotation_rad =
      core::angle_between(one.normal_rad() + constraint.rotation_rad, other.normal_rad());
  const double angle_weight = 1 / (constraint.sigma_rad * constraint.sigma_rad);
  equations_.add<2>({a, b}, {-1, 1}, rotation_rad, angle_weight);
  if (!constraint.on_one_line) return;
  // The middle of `other` lies on `one`.
  const double other_along_m = (other.begin_m() + other.end_m()) / 2;
  const core::Vec2 middle = other.at(other_along_m);
  equations_.add<4>({a, a + 1, b, b + 1}, {-one.along_of(middle), -1, other_along_m, 1},
                    one.height_of(middle), 1 / (constraint.sigma_m * constraint.sigma_m));
}

}  // namespace cornerd::survey
