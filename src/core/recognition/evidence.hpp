// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/recognition/explanation.hpp"

namespace cornerd::core {

/// Evidence of one scan for one hypothesis, whatever the competing ones have.
struct Evidence {
  BeamLikelihood likelihood;
  std::size_t corners = 0;     ///< breakpoints with a landmark on the map
  double largest_gap_rad = 0;  ///< largest gap of the field of view
  bool exhaustive = true;      ///< every hypothesis of the scan's walls was tested
  bool at_prior = false;       ///< agrees with a prior of small uncertainty
};

/// Corners of a place that is certain.
inline constexpr std::size_t kCertainCorners = 2;

/// True where the field of view has no gap of 170 degrees or more: the lidar was not covered.
bool has_full_coverage(double largest_gap_rad);

/// True where no further hypotheses need a test: hardly any ray is left for a competing one.
/// `expected`: near the prior, where unmapped obstacles may take a larger share.
bool is_conclusive(const BeamLikelihood& likelihood, bool expected);

/// True where the scan alone gives a fix.
bool is_unambiguous_fix(const Evidence& evidence);

/// True where scan and prior together give a pose. What a covered lidar still sees may be one wall,
/// along which the pose slides: then a corner at the prior is required.
bool may_be_tracked(const Evidence& evidence);

/// True where a fix has to be confirmed by the next scan: with a large gap and not at the prior, or
/// far from the prior without being conclusive. `expected`: near the prior.
bool needs_confirmation(const Evidence& evidence, bool expected, bool has_prior);

}  // namespace cornerd::core
