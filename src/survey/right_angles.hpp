// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/adjustment.hpp"

namespace cornerd::survey {

struct RightAngles {
  std::vector<FaceConstraint> constraints;  ///< make faces square to the longest one
  std::size_t askew = 0;                    ///< faces without a constraint
};

/// Makes faces of an adjusted drive square that are so within three sigmas of what the drive knows
/// of their directions, and within half a degree. `faces`: those that are tried about.
RightAngles right_angles(const MappedDrive& drive, std::span<const std::uint32_t> faces);

}  // namespace cornerd::survey
