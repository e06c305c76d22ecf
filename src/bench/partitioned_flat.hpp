// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// A random flat of 5 x 5 to 18 x 14 m: rooms by recursive partition, with doors, cupboards and now
/// and then an oblique wall.
core::FloorPlan partitioned_flat(std::uint64_t seed);
/// The same with what makes rooms look alike, also in a mirror: walls on a grid of 25 cm, doors of
/// one width, and hardly any furniture.
core::FloorPlan plain_flat(std::uint64_t seed);

}  // namespace cornerd::bench
