// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::tool {

/// The four layouts of the KRPAI 2019 arena, krpai-2019-a.json to -d.json: from `folder`, or where
/// that is empty from the source tree or the installation that this program belongs to.
/// Throws settings::SettingsError, or UsageError where no folder has them.
std::vector<std::shared_ptr<const core::WallMap>> load_contest_maps(
    const std::filesystem::path& folder);

}  // namespace cornerd::tool
