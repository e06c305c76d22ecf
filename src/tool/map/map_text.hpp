// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/map/wall_map.hpp"

namespace cornerd::tool {

class Command;

/// Options of a command that makes a map.
struct MapOutput {
  std::filesystem::path output;
  std::filesystem::path plot;
  std::string name;

  /// -o, --name and --plot. `plotted`: the content of the plot.
  void add(Command& command, const std::string& plotted);

  /// Names the plan, if it has no name or --name is given, and writes it. Throws Failure before it
  /// writes if the plan is no valid map.
  std::shared_ptr<const core::WallMap> write(core::FloorPlan& plan) const;
};

/// "2.418 x 2.418 m, 13 walls, 40 corners"
std::string describe_map(const core::WallMap& map);

}  // namespace cornerd::tool
