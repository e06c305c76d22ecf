// SPDX-License-Identifier: MIT
// Generated buildings of any size.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// Offices on both sides of corridors, joined by a corridor along the building's side. Each named
/// room has a random width, door and cupboard. The building has about `corners` corners, inside and
/// outside.
core::FloorPlan office_building(std::size_t corners, std::uint64_t seed);

/// A corridor with `rooms` identical rooms on one side.
core::FloorPlan equal_rooms(std::size_t rooms);

/// A straight corridor of 20 to 80 m, 1.2 to 3 m wide, with niches and rooms of two widths at
/// random on both sides: long stretches are bare, and many look alike.
core::FloorPlan long_corridor(std::uint64_t seed);

/// A corridor of 1.6 m around a block of 16.8 x 4.8 m. Its lower side is bare; pillars stand on the
/// others.
core::FloorPlan ring_corridor();

}  // namespace cornerd::bench
