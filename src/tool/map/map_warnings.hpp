// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::tool {

/// What is valid in a map and probably a mistake of the drawing, each in a sentence that says what
/// to do. Walls and rooms are numbered from 0, as in errors of the map.
std::vector<std::string> map_warnings(const core::WallMap& map);

/// One line for each; the first ones where there are many. Empty if there is none.
std::string describe_warnings(const std::vector<std::string>& warnings);

}  // namespace cornerd::tool
