// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/mapped_drive.hpp"
#include "survey/mapped_face.hpp"

namespace cornerd::survey {

/// What is believed of two faces beyond what was seen of them.
struct FaceBond {
  std::uint32_t one = 0;
  std::uint32_t other = 0;
  double rotation_rad = 0;   ///< from the normal of `one` to that of `other`
  bool on_one_line = false;  ///< and they lie on one line
  double sigma_rad = 0.0001;
  double sigma_m = 0.0001;
};

struct AdjustmentResult {
  double sigma = 0;  ///< of the observations' residuals, in units of their doubts
  std::size_t outliers = 0;
  int steps = 0;
};

/// Sparse least squares over all poses of a drive and all faces of the map at once: each
/// observation ties a pose to a face, each link a pose to the one before, each of the drive's ties
/// a pose to one long before. The first pose stays where it is. What contradicts all others loses
/// its weight. Poses, lines and the
/// lines' covariances are changed in place.
AdjustmentResult adjust(MappedDrive& drive, std::span<const FaceBond> bonds = {});

/// How well an adjusted drive knows the way from one turn to another: of (x [m], y [m],
/// theta [rad]) in the frame of the first. Zero where nothing is known of it.
core::Covariance3 covariance_of_way(const MappedDrive& drive, std::size_t from, std::size_t to);

/// How well an adjusted drive knows the turn from the normal of one face to those of others: a
/// variance (rad^2) for each of these, infinite where nothing is known of it.
std::vector<double> rotation_variances(const MappedDrive& drive, std::uint32_t from,
                                       std::span<const std::uint32_t> to);

}  // namespace cornerd::survey
