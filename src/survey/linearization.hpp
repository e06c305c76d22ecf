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

/// What the way from one pose to another deviates from `expected` by, in the frame of the first,
/// and how that changes with (x, y, theta) of both.
struct WayResidual {
  WayResidual(const core::Pose2& from, const core::Pose2& to, const core::Pose2& expected);
  std::array<double, 3> off{};
  std::array<std::array<double, 6>, 3> slope{};
};

/// All that is known of a drive, as equations about small changes of its poses (three unknowns
/// each, but for the first) and of its faces (two each). What contradicts all else has lost its
/// weight.
class Linearization {
 public:
  /// `leniency`: by how much later things lose their weight than they do in the end.
  Linearization(const MappedDrive& drive, std::span<const FaceBond> bonds, double leniency);

  const NormalEquations& equations() const { return equations_; }
  /// Of the observations, capped where they lose their weight.
  double chi_square() const { return chi_square_; }
  /// Observations that lost more than half of their weight.
  std::size_t outliers() const { return outliers_; }
  /// Of a face's line (angle, offset at the anchor), if all poses were known.
  const Eigen::Matrix2d& information_of(std::size_t face) const { return information_[face]; }

  /// The first of its unknowns; -3 for the first turn, which is fixed.
  int pose_unknown(std::size_t scan) const { return 3 * (static_cast<int>(scan) - 1); }
  int face_unknown(std::size_t face) const { return first_face_ + 2 * static_cast<int>(face); }

  std::array<int, 6> unknowns_of(std::size_t from, std::size_t to) const;

 private:
  static int or_fixed(int unknown, int part) { return unknown < 0 ? -1 : unknown + part; }
  void add(const Observation& observation);
  void add_link(std::size_t scan);
  void add_tie(const PlaceTie& tie);
  void add_way(std::size_t from, std::size_t to, const core::Pose2& expected,
               const Eigen::Vector3d& variance, double half);
  void add_bond(const FaceBond& bond);

  const MappedDrive& drive_;
  double leniency_;
  int first_face_;
  NormalEquations equations_;
  std::vector<Eigen::Matrix2d> information_;
  double chi_square_ = 0;
  std::size_t outliers_ = 0;
};

}  // namespace cornerd::survey
