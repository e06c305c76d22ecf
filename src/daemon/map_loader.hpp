// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/map/wall_map.hpp"
#include "core/pipeline.hpp"
#include "daemon/outbox.hpp"
#include "message/request.hpp"
#include "settings/config.hpp"

namespace cornerd::daemon {

/// The config, its map, and a pipeline for them.
struct Loaded {
  settings::Config config;
  std::shared_ptr<const core::WallMap> map;
  Line map_line;  ///< MAP
  std::unique_ptr<core::Pipeline> pipeline;
};

/// Loads what a pipeline needs. Takes seconds where the map is large. Throws SettingsError where
/// config or map is invalid; the next load is then the same as without that call.
class MapLoader {
 public:
  /// `overrides`: "/json/pointer=value".
  MapLoader(std::filesystem::path config_file, std::vector<std::string> overrides);

  /// Reads the config and its maps, and throws what is wrong with them.
  void check() const;
  /// Reads the config and its map.
  Loaded load();
  /// Another map in the config of the last load(), which has succeeded.
  Loaded load(const message::SetMapRequest& request);
  /// The same config and map for this lidar, also in later loads. Without a pipeline where the
  /// config has a noise of its own.
  Loaded load(const drivers::LidarModel& model);

 private:
  Loaded with_map(settings::Config config);
  settings::Config parse() const;

  std::filesystem::path config_file_;
  std::vector<std::string> overrides_;
  const drivers::LidarModel* model_ = nullptr;
  std::string text_;         ///< of the config, at the last load()
  settings::Config config_;  ///< of it
  settings::Config used_;    ///< with the map of the last SET_MAP
};

}  // namespace cornerd::daemon
