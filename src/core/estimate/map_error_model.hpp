// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/estimate/line_sums.hpp"
#include "core/geometry/pose2.hpp"

namespace cornerd::core {

/// The residual of one face.
struct FaceResidual : LineSums {
  /// Of the pose (x, y, theta): the weighted sum of the points' Jacobians.
  Eigen::Vector3d gradient() const { return {weight * normal.x(), weight * normal.y(), lever}; }

  double direction_variance(double sigma_m) const {
    return core::direction_variance(length_m, sigma_m);
  }
  /// For a pose that is off by so much (x, y, theta).
  void move_pose(const Eigen::Vector3d& by) {
    const double across_m = normal.dot(by.head<2>());
    distance += across_m * weight + by.z() * lever;
    distance_lever += across_m * lever + by.z() * lever_squared;
  }

  std::uint32_t face = 0;
  Vec2 normal;
  double length_m = 0;
};

/// One residual a face, in the order of their numbers: sums those of one face.
void merge_by_face(std::vector<FaceResidual>& residuals);

/// What a refined scan shows of faces that are displaced from the map. All points of such a face
/// are off together, so that no number of points averages the error out. Causes: hand-measured
/// walls, an unknown range bias, motion distortion.
struct FaceResidualStatistics {
  double excess = 0;               ///< of the faces' mean squared distances over the points' noise
  double excess_variance = 0;      ///< variance of `excess` where no face is displaced
  double excess_per_variance = 0;  ///< expected excess per m^2 of the faces' variance
  /// Of a map measured with a tape, against one whose faces are off by shown_variance_m2() (nats).
  double log_odds_of_tape = 0;
  /// Pose covariance (x, y, theta) per m^2 of the faces' variance.
  Covariance3 covariance_per_variance = Covariance3::Zero();

  /// Exact faces would show as much once in 700 scans.
  bool shows_offsets() const { return excess > 3 * std::sqrt(excess_variance); }
  /// Expected, of the faces' offsets: as the scan shows it, or that of a map measured with a tape
  /// by the odds that its faces show no more by chance; 0 where there is nothing to compare.
  double variance_m2() const;
  /// The faces are where the map has them but for the roughness of walls.
  bool excludes_offsets() const;

  /// Without a margin half of all scans of an exact map show some excess by chance.
  double shown_variance_m2() const;
};

/// `residuals`: at the pose that fits the points best, one a face. `covariance`: of that pose by
/// the points' noise alone. Leaves out what is of lines, which the next two functions give.
FaceResidualStatistics face_residual_statistics(std::span<const FaceResidual> residuals,
                                                const Covariance3& covariance);

/// Pose covariance per m^2 of the offsets' variance. `residuals`: one a line (merge_by_line()).
Covariance3 covariance_per_variance(std::span<const FaceResidual> residuals,
                                    const Covariance3& covariance);
/// Log odds (nats) of lines that are off by N(0, 1 cm), as a whole or each end by itself, against
/// N(0, shown_m2), each as likely before the scan (map_error_model_test.cpp).
double log_odds_of_tape(std::span<const FaceResidual> residuals, const Covariance3& covariance,
                        double shown_m2);

/// Map error model: the variance of the faces' positions, averaged over the last scans since one
/// scan sees too few faces.
class MapErrorModel {
 public:
  void add(const FaceResidualStatistics& statistics);
  /// To be added to the covariance of a pose with these residuals, in which no offset was
  /// marginalised.
  Covariance3 pose_covariance(const FaceResidualStatistics& statistics) const;
  double variance_m2() const { return sum_.variance_m2(); }
  /// True where the last scans show that faces are where the map has them.
  bool is_exact() const { return sum_.excludes_offsets(); }
  void forget() { *this = {}; }

 private:
  /// Over the scans, with exponential forgetting. The log odds are their mean by what each scan can
  /// show: scans of one place see the same faces.
  FaceResidualStatistics sum_;
};

}  // namespace cornerd::core
