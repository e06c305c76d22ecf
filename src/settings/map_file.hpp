// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/map/wall_map.hpp"
#include "settings/config.hpp"

namespace cornerd::settings {

/// Largest absolute x or y of a map's points, metres.
inline constexpr double kMaxCoordinateM = 10'000;

/// Of a wall, metres.
inline constexpr double kMaxThicknessM = 10;

/// Of a map larger than a building is; else empty.
std::string size_warning(const core::WallMap& map);

/// A map file's bytes. Throws SettingsError where it cannot be read or is too large.
std::string read_map_text(const std::filesystem::path& file, FileKind kind = FileKind::kAny);

/// Reads a cornerd-map. Throws SettingsError with file, JSON pointer and reason.
core::FloorPlan parse_floor_plan(std::string_view text, const std::filesystem::path& file);
std::shared_ptr<const core::WallMap> parse_map(std::string_view text,
                                               const std::filesystem::path& file);
/// `name`: in place of the map's own; may be empty.
std::shared_ptr<const core::WallMap> load_map(const std::filesystem::path& file,
                                              FileKind kind = FileKind::kAny,
                                              const std::string& name = {});

}  // namespace cornerd::settings
