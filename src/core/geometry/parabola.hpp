// SPDX-License-Identifier: MIT
#pragma once

namespace cornerd::core {

/// Where a parabola is least, as a share of the step from one value to the next: it is `before` and
/// `after` higher at its neighbours than at the least of the three.
constexpr double least_of_parabola(double before, double after) {
  return before + after > 0 ? (before - after) / (2 * (before + after)) : 0;
}

}  // namespace cornerd::core
