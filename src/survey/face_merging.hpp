// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "survey/evidence.hpp"
#include "survey/mapped_drive.hpp"

namespace cornerd::survey {

/// How far two faces may deviate that are one: a wall that was seen twice, from two ends of a
/// drive.
struct MergeLimits {
  double place_m = 0.02;
  double heading_rad = core::radians(1.5);
  /// Along the wall, where no ray went through.
  double gap_m = 0.3;
  /// Across the wall, where rays ended on both at the same places: the one in front would have
  /// hidden the other, so that they are one that was mapped twice.
  double double_m = 0.1;
  double double_rad = core::radians(5);
};

/// Makes one face of those that are: they look the same way, lie on one line within what is known
/// of both and the limits, and overlap, or leave a gap that nothing was seen through. `evidence`:
/// of the faces, or empty for those that overlap alone. Returns how many were merged into others.
std::size_t merge_faces(MappedDrive& drive, const std::vector<FaceEvidence>& evidence,
                        const MergeLimits& limits);

}  // namespace cornerd::survey
