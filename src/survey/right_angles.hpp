// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "survey/adjustment.hpp"

namespace cornerd::survey {

/// Bonds that make walls square to the longest face: those that are so within what is known of them
/// and half a degree. A wall that is not stays as it was seen.
std::vector<FaceBond> right_angles(const MappedDrive& drive);

}  // namespace cornerd::survey
