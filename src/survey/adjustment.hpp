// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/line_landmark.hpp"
#include "survey/mapped_drive.hpp"

namespace cornerd::survey {

/// A prior on the relative direction, and offset, of two faces.
struct FaceConstraint {
  std::uint32_t one = 0;
  std::uint32_t other = 0;
  double rotation_rad = 0;   ///< from the normal of `one` to that of `other`
  bool on_one_line = false;  ///< both lie on one line
  double sigma_rad = 0.0001;
  double sigma_m = 0.0001;
};

struct AdjustmentResult {
  double sigma = 0;  ///< RMS of the observations' normalised residuals
  std::size_t outliers = 0;
  int steps = 0;
};

/// Sparse robust least squares over all poses and faces of a drive (graph SLAM): line observations,
/// odometry edges, loop constraints and face constraints. The first pose is fixed. Changes poses,
/// lines and the lines' covariances in place.
AdjustmentResult adjust(MappedDrive& drive, std::span<const FaceConstraint> constraints = {});

/// Covariance of the pose of scan `to` relative to scan `from`, in the frame of `from`: of (x [m],
/// y [m], theta [rad]). Zero where the equations cannot be solved.
core::Covariance3 relative_pose_covariance(const MappedDrive& drive, std::size_t from,
                                           std::size_t to);

/// Variance (rad^2) of the angle from the normal of face `from` to that of each face in `to`.
/// Infinite where the equations cannot be solved.
std::vector<double> rotation_variances(const MappedDrive& drive, std::uint32_t from,
                                       std::span<const std::uint32_t> to);

}  // namespace cornerd::survey
