// SPDX-License-Identifier: MIT
// Buildings that differ from their map by the positions of their walls.
#pragma once

#include <cstdint>
#include <span>

#include "core/map/wall_map.hpp"

namespace cornerd::replay {

/// The wall moved along its normal, metres. A wall without length does not move.
core::Wall displaced(const core::Wall& wall, double by_m);

/// Each wall moved along its normal, metres, one number for each. Walls that meet still meet: an
/// end that touches another wall follows it.
core::FloorPlan with_walls_moved(const core::FloorPlan& plan, std::span<const double> by_m);

/// Each wall moved along its normal by N(0, sigma_m), drawn for each wall. Throws
/// std::invalid_argument if `sigma_m` is negative or not finite.
core::FloorPlan with_map_error(const core::FloorPlan& plan, double sigma_m, std::uint64_t seed);

/// Each end of a wall moved by N(0, sigma_m) in x and in y, so that walls are turned; ends at the
/// same point stay together, one at another wall's side is left behind. Throws as with_map_error().
core::FloorPlan with_end_error(const core::FloorPlan& plan, double sigma_m, std::uint64_t seed);

}  // namespace cornerd::replay
