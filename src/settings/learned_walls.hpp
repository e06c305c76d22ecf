// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/estimate/map_changes.hpp"
#include "core/estimate/wall_offset_filter.hpp"

namespace cornerd::settings {

/// What the daemon learned of a map's walls, kept in a file for the next run.
struct LearnedWallsOfMap {
  std::string map_hash;  ///< FloorPlan::hash
  core::LearnedWalls walls;
  std::vector<core::MapChange> changes;

  /// True where each wall is one of a map of so many.
  bool fits(std::size_t walls_of_map) const;
};

inline constexpr std::size_t kMaxLearnedWallsBytes = 2U << 20U;

/// "walls-HASH.json", with the first digits of the map's hash.
std::string learned_walls_name(std::string_view map_hash);

/// `file` names it in errors. Throws SettingsError.
LearnedWallsOfMap parse_learned_walls(std::string_view text, const std::filesystem::path& file);
std::string text_of(const LearnedWallsOfMap& learned);

/// The middle of the wall that is gone, one of `plan`; where the new thing is.
core::Vec2 place_of(const core::MapChange& change, const core::FloorPlan& plan);
/// "wall 12 at (1.20, 3.40) is gone"; a wall of `plan`.
std::string describe(const core::MapChange& change, const core::FloorPlan& plan);

}  // namespace cornerd::settings
