// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// Errors of a plan drawn by hand, standard deviations.
inline constexpr double kDrawnAcross_m = 0.03;
inline constexpr double kDrawnAlong_m = 0.05;

/// A building as somebody draws it: each wall off by kDrawnAcross_m, which is the plan's sigma, and
/// free ends by kDrawnAlong_m; walls that meet still meet. One wall in fifteen is missing, and one
/// that is not there is drawn: a screen of half a metre. Deterministic.
core::FloorPlan drawn_plan(const core::FloorPlan& building, std::uint64_t seed);

/// Points of a drive of at least `length_m` in straight lines, 20 cm clear of all walls. Throws
/// std::runtime_error where the building has no room for it. Deterministic.
std::vector<core::Vec2> random_drive(const core::WallMap& building, double length_m,
                                     std::uint64_t seed);

}  // namespace cornerd::bench
