// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::tool {

/// A place of a building, and the others that one turn of a lidar cannot tell from it.
struct ExaminedPlace {
  core::Pose2 place;
  bool is_known = false;                 ///< a turn taken there names it
  bool is_lost = false;                  ///< or it fits nowhere: too little is seen from there
  std::vector<core::Pose2> look_alikes;  ///< without the place itself; none where it is known
};

/// Takes a simulated turn at each point of a lattice over the building, as an A1 would, and asks
/// the localizer where that was. `count`: about so many places. Equal on every run.
std::vector<ExaminedPlace> examine_places(const std::shared_ptr<const core::WallMap>& map,
                                          std::size_t count);

/// What map check says of them: the rooms that are taken for each other, or places where the map
/// names no rooms. Lines that begin with what they are about.
std::string describe_look_alikes(const core::WallMap& map,
                                 const std::vector<ExaminedPlace>& places);

}  // namespace cornerd::tool
