// SPDX-License-Identifier: MIT
// A map beside what the daemon has learned of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "settings/learned_walls.hpp"

namespace cornerd::tool {

/// `given`, or where that is empty the packaged service's file of this map.
std::filesystem::path learned_walls_file(const core::FloorPlan& plan,
                                         const std::filesystem::path& given);

/// Throws SettingsError, or Failure where the file is of another map.
settings::LearnedWallsOfMap load_learned_walls(const core::FloorPlan& plan,
                                               const std::filesystem::path& file);

/// The walls where they were learned to be, with their sigma.
core::FloorPlan with_learned_walls(const core::FloorPlan& plan, const core::LearnedWalls& walls);

/// Leaves out those walls of the changes that are gone; the others keep their order.
core::FloorPlan without_gone_walls(core::FloorPlan plan,
                                   const std::vector<core::MapChange>& changes);

}  // namespace cornerd::tool
