// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "survey/face_evidence.hpp"
#include "survey/mapped_drive.hpp"

namespace cornerd::survey {

/// Limits within which two faces are one wall face that was mapped twice.
struct MergeLimits {
  double place_m = 0.02;
  double heading_rad = core::radians(1.5);
  /// Largest gap along the wall: it goes on behind a door.
  double gap_m = 1.2;
  /// Largest offset and angle of duplicate walls: rays ended on both at the same coordinates,
  /// although the front face would have hidden the one behind.
  double duplicate_m = 0.1;
  double duplicate_rad = core::radians(5);
};

/// Merges faces with the same normal that lie on one line within their covariances and the limits,
/// and overlap or leave a gap of at most gap_m. `evidence`: of the faces; where it is empty only
/// faces that overlap are merged. Returns the number of faces merged into others.
std::size_t merge_faces(MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                        const MergeLimits& limits);

/// Splits each face that was out of sight while the robot travelled more than `distance_m` and was
/// observed again in `from_scan` or later: the scan matching may have taken another wall for it.
/// merge_faces() merges correct matches again. Returns the number of faces split.
std::size_t split_revisited(MappedDrive& drive, std::size_t from_scan, double distance_m);

}  // namespace cornerd::survey
