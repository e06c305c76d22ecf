// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "core/estimate/map_error_model.hpp"
#include "core/geometry/squared.hpp"

namespace cornerd::core {

/// A refinement's normal equations in the pose (x, y, theta), with the walls' errors marginalised.
struct NormalEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d of_offsets = Eigen::Matrix3d::Zero();  ///< what marginalisation took of it
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Vector3d gradient_of_offsets = Eigen::Vector3d::Zero();  ///< the same
  double of_directions = 0;                                       ///< of the heading's information
  double heading_of_directions = 0;                               ///< of the heading's gradient
  double chi_square = 0;
  double squared_distances = 0;
  std::size_t inliers = 0;
  Eigen::Matrix2d normals = Eigen::Matrix2d::Zero();  ///< sum of the inliers' n n'
  double uneven_share = 1;                            ///< that the points' variances are of
  double uneven_points = 0;                           ///< points about their walls' own planes
  double uneven_square = 0;  ///< sum of their squared distances over the variances
  double uneven_weight = 0;  ///< sum of the inverse variances over those of the walls' offsets

  /// As for all that follow, in variances of the walls' offsets.
  double mean_variance() const { return uneven_points / uneven_weight; }
  /// The share by which the points are as uneven as they are.
  double shown_share() const {
    const double excess = (uneven_square / uneven_points - 1) * mean_variance();
    return std::sqrt(std::max(0.0, squared(uneven_share) + excess));
  }
  /// The points' variance over the sensor's own, which is a hundredth of it at least.
  double variance_over_sensor() const {
    return 1 / std::max(0.01, 1 - squared(uneven_share) / mean_variance());
  }

  /// The normal equations before directions were marginalised, and with all else that was.
  Eigen::Matrix3d information_of_parallel() const {
    Eigen::Matrix3d parallel = information;
    parallel(2, 2) += of_directions;
    return parallel;
  }
  Eigen::Vector3d gradient_of_parallel() const {
    return gradient + heading_of_directions * Eigen::Vector3d::UnitZ();
  }

  /// Eliminates the direction of a face.
  void marginalise_direction(const FaceResidual& face, double variance) {
    const LineSums::Eliminated eliminated = face.eliminate_direction(variance);
    of_directions += eliminated.information;
    heading_of_directions += eliminated.gradient;
    chi_square -= eliminated.chi_square;
  }

  /// Eliminates the offset of a face: the Schur complement, of rank one.
  void marginalise(const FaceResidual& face, double sigma_m) {
    const Eigen::Vector3d by_offset = face.gradient();
    const double share = 1 / (face.weight + 1 / squared(sigma_m));
    of_offsets += share * by_offset * by_offset.transpose();
    gradient -= share * face.distance * by_offset;
    gradient_of_offsets += share * face.distance * by_offset;
    chi_square -= share * squared(face.distance);
  }
};

}  // namespace cornerd::core
