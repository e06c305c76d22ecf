// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/recognition/explanation.hpp"

namespace cornerd::core {

/// Corners of a place that is certain.
inline constexpr std::size_t kCertainCorners = 2;

/// True where the field of view has no gap of 170 degrees or more: the lidar was not covered.
bool has_full_coverage(double largest_gap_rad);

/// True where no further hypotheses need a test: hardly any ray is left for a competing one.
/// `expected`: near the prior, where unmapped obstacles may take a larger share.
bool is_conclusive(const BeamLikelihood& likelihood, bool expected);

/// True where so many rays hit within the sensor's noise that the map is exact there: rivals are
/// then compared ray by ray.
bool is_exact(const BeamLikelihood& likelihood, bool expected);

}  // namespace cornerd::core
