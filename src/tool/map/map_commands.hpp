// SPDX-License-Identifier: MIT
// The subcommands of cornerctl map that have files of their own.
#pragma once

#include <string>

#include "core/map/wall_map.hpp"

namespace CLI {
class App;
}

namespace cornerd::tool {

void add_map_render(CLI::App& group);
void add_map_import(CLI::App& group);

/// "2.418 x 2.418 m, 13 walls, 40 corners"
std::string describe_map(const core::WallMap& map);

}  // namespace cornerd::tool
