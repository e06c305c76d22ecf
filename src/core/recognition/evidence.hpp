// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/recognition/explanation.hpp"

namespace cornerd::core {

/// What a turn says for one place, whatever it says of others.
struct Evidence {
  Explanation explanation;
  std::size_t corners = 0;    ///< breakpoints that the map has there too
  double widest_gap_rad = 0;  ///< between two returns
  bool all_tried = true;      ///< every other place that the turn's walls could have pointed to
  bool at_prior = false;      ///< it is where the robot can only be by what was known before
};

/// True of a turn that shows something on nearly all sides: the lidar was not covered meanwhile.
bool is_whole(double widest_gap_rad);

/// True where no other place needs to be looked for: hardly a ray is left that another one could
/// explain. `expected`: the robot should be about there by what was known before; then things that
/// are not on the map may take their part.
bool leaves_no_doubt(const Explanation& explanation, bool expected);

/// True where the place is believed though nothing was known before.
bool is_evident(const Evidence& evidence);

/// True where the place is believed if the robot was expected there. What a covered lidar still
/// sees may be one wall, along which a place slides: then a corner has to hold it, and that where
/// it was expected, for rooms have several.
bool may_be_tracked(const Evidence& evidence);

/// True where a place that is evident is believed only with the next turn: half a turn's that is
/// not exactly where it was expected, and where the robot was somewhere else just before, unless it
/// is certain. `expected`: it is about where the robot should be.
bool needs_a_second(const Evidence& evidence, bool expected, bool has_prior);

}  // namespace cornerd::core
