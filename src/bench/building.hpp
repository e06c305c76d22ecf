// SPDX-License-Identifier: MIT
// Buildings of any size, to see how the localizer's cost grows and where it is in doubt.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// Offices on both sides of corridors, which a corridor along the building's side joins. Each room
/// has a width, a door and a cupboard of its own. So many rooms that there are about `corners`
/// corners, as a lidar sees them, outside and inside. Rooms are named.
core::FloorPlan office_building(std::size_t corners, std::uint64_t seed);

/// A corridor with `rooms` rooms on one side that are equal to the millimetre.
core::FloorPlan equal_rooms(std::size_t rooms);

/// A corridor of 1.6 m around a block of 16.8 x 4.8 m. Its lower side is bare; pillars stand on the
/// others.
core::FloorPlan ring_corridor();

}  // namespace cornerd::bench
