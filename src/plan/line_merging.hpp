// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "plan/drawing.hpp"

namespace cornerd::plan {

/// A line by its direction and length.
struct Line {
  core::Vec2 from = core::Vec2::Zero();
  core::Vec2 along = core::Vec2::UnitX();  ///< unit vector
  double length_m = 0;

  core::Vec2 at(double distance_m) const { return from + distance_m * along; }
  core::Vec2 to() const { return at(length_m); }
};

/// Lines that continue or overlap each other on one line, within a millimetre, as one. Shorter ones
/// than that are left out.
std::vector<Line> merge_lines(std::span<const DrawnLine> lines);

}  // namespace cornerd::plan
