// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "survey/adjustment.hpp"
#include "survey/mapped_drive.hpp"
#include "survey/normal_equations.hpp"

namespace cornerd::survey {

/// Relative pose of `to` in the frame of `from`, minus `expected`, and its Jacobian (3 x 6) with
/// respect to (x, y, theta) of both.
struct RelativePoseResidual {
  RelativePoseResidual(const core::Pose2& from, const core::Pose2& to, const core::Pose2& expected);
  std::array<double, 3> off{};
  std::array<std::array<double, 6>, 3> jacobian{};
};

/// The linearised residuals of a drive. Unknowns: three for each pose but the first, two for each
/// face. Residuals have Cauchy weights.
class Linearization {
 public:
  /// `gnc_scale`: factor on the kernel widths (squared) of observations and loop constraints.
  Linearization(const MappedDrive& drive, std::span<const FaceConstraint> constraints,
                double gnc_scale);

  const NormalEquations& equations() const { return equations_; }
  /// Sum over the observations, each capped at the kernel width.
  double chi_square() const { return chi_square_; }
  /// Observations with less than half of their weight.
  std::size_t outliers() const { return outliers_; }
  /// Information of a face's (angle, offset at the anchor), given all poses.
  const Eigen::Matrix2d& information_of(std::size_t face) const { return information_[face]; }

  /// Index of the first unknown; -3 for the first scan, which is fixed.
  int pose_unknown(std::size_t scan) const { return 3 * (static_cast<int>(scan) - 1); }
  int face_unknown(std::size_t face) const { return first_face_ + 2 * static_cast<int>(face); }

  std::array<int, 6> unknowns_of(std::size_t from, std::size_t to) const;

 private:
  static int or_fixed(int unknown, int part) { return unknown < 0 ? -1 : unknown + part; }
  void add(const MatchedObservation& observation);
  void add_odometry_edge(std::size_t scan);
  void add_loop_constraint(const LoopConstraint& constraint);
  void add_relative_pose(std::size_t from, std::size_t to, const core::Pose2& expected,
                         const Eigen::Vector3d& variance, double half);
  void add_face_constraint(const FaceConstraint& constraint);

  const MappedDrive& drive_;
  double gnc_scale_;
  int first_face_;
  NormalEquations equations_;
  std::vector<Eigen::Matrix2d> information_;
  double chi_square_ = 0;
  std::size_t outliers_ = 0;
};

}  // namespace cornerd::survey
