// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"
#include "tool/drawing/map_drawing.hpp"

namespace cornerd::tool {

/// Localizes a simulated A1 scan at each point of a lattice over the building. `count`: approximate
/// number of places. Deterministic.
std::vector<ExaminedPlace> examine_places(const std::shared_ptr<const core::WallMap>& map,
                                          std::size_t count);

/// The report of map check: rooms, or places if the map names no rooms, that look alike.
std::string describe_look_alikes(const core::WallMap& map,
                                 const std::vector<ExaminedPlace>& places);

}  // namespace cornerd::tool
