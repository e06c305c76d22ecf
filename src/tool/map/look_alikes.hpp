// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"
#include "tool/drawing/map_drawing.hpp"

namespace cornerd::tool {

/// Takes a simulated scan at each point of a lattice over the building, as an A1 would, and asks
/// the localizer where that was. `count`: about so many places. Equal on every run.
std::vector<ExaminedPlace> examine_places(const std::shared_ptr<const core::WallMap>& map,
                                          std::size_t count);

/// What map check says of them: the rooms that are taken for each other, or places where the map
/// names no rooms. Lines that begin with what they are about.
std::string describe_look_alikes(const core::WallMap& map,
                                 const std::vector<ExaminedPlace>& places);

}  // namespace cornerd::tool
