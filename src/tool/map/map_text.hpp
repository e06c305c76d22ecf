// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/map/wall_map.hpp"

namespace cornerd::tool {

/// The name that the user gave, else the file's.
std::string map_name(const std::string& given, const std::filesystem::path& file);

/// A map file of these walls; rooms are left out.
std::string map_text(const core::FloorPlan& plan);

/// Parses `text` before it is written. Throws Failure if it is no valid map.
std::shared_ptr<const core::WallMap> read_back(const std::string& text,
                                               const std::filesystem::path& file);

/// "2.418 x 2.418 m, 13 walls, 40 corners"
std::string describe_map(const core::WallMap& map);

}  // namespace cornerd::tool
