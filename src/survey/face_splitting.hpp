// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "survey/mapped_drive.hpp"

namespace cornerd::survey {

/// Makes two faces of each that was out of sight while the robot drove more than `way_m`, and came
/// in sight again in `from_scan` or later: what the matching took for the same wall may be another.
/// Merging makes one of them again where they are. Returns how many were split.
std::size_t split_revisited(MappedDrive& drive, std::size_t from_scan, double way_m);

}  // namespace cornerd::survey
