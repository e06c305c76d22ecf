// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "settings/map_file.hpp"

namespace cornerd::bench {

/// The four layouts of the contest arena.
inline std::vector<std::shared_ptr<const core::WallMap>> contest_maps() {
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  for (const char layout : {'a', 'b', 'c', 'd'}) {
    maps.push_back(settings::load_map(std::string(CORNERD_SOURCE_DIR "/config/maps/krpai-2019-") +
                                      layout + ".json"));
  }
  return maps;
}

}  // namespace cornerd::bench
