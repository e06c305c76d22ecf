// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::core {

/// Offset of a parabola's minimum from its lowest sample, in units of the step: `before` and
/// `after` are its neighbours' excess over the lowest sample.
constexpr double parabola_minimum(double before, double after) {
  return before + after > 0 ? (before - after) / (2 * (before + after)) : 0;
}

}  // namespace cornerd::core
