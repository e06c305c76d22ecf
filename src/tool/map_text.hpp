// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/map/wall_map.hpp"

namespace cornerd::tool {

/// A map file of these walls; rooms are left out.
std::string map_text(const core::FloorPlan& plan);

}  // namespace cornerd::tool
