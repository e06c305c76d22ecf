// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::bench {

/// The folder of the four layouts of the KRPAI 2019 arena, krpai-2019-a.json to -d.json: `named`,
/// or if empty that of the source tree or of the installation. Throws UsageError if none has them.
std::filesystem::path contest_maps_folder(const std::filesystem::path& named);

/// All four; `folder` as above. Throws settings::SettingsError, too.
std::vector<std::shared_ptr<const core::WallMap>> load_contest_maps(
    const std::filesystem::path& folder);

}  // namespace cornerd::bench
