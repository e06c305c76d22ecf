// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "core/estimate/map_error_model.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Standard deviation of faces' offsets across themselves, m, by their residuals where it was
/// `sigma_m` so far and the map states `stated_m`: a step of the EM algorithm (Dempster, Laird and
/// Rubin 1977) with a prior. At most 5 cm, or `stated_m`.
double sigma_of_offsets(std::span<const FaceResidual> residuals, const WallMap& map,
                        double stated_m, double sigma_m);

/// Walls that are off as a whole keep their direction; where each end is off by itself they are
/// turned. The share of FaceResidual::direction_variance() of `sigma_m`, or of the face's own where
/// that is more, that a scan shows: the mean of its posterior over 0, 1/64, 1/16, 1/4 and 1, each
/// as likely before. `information` and
/// `gradient`: of the pose's normal equations (x, y, theta), with no direction marginalised.
double shown_direction_share(std::span<const FaceResidual> residuals, const WallMap& map,
                             double sigma_m, const Eigen::Matrix3d& information,
                             const Eigen::Vector3d& gradient);

/// One residual a line: sums those of faces that may be off together.
void merge_by_line(std::vector<FaceResidual>& residuals, const WallMap& map);

/// Normal equations whose faces' offsets of `sigma_m` are marginalised, each by itself: what the
/// variance of their right side (x, y, theta) has beyond their information where the faces of a
/// line are off together.
Covariance3 variance_of_lines(std::span<const FaceResidual> residuals, const WallMap& map,
                              double sigma_m);

}  // namespace cornerd::core
