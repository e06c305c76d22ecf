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

/// A map with its MAP.
struct LoadedMap {
  std::shared_ptr<const core::WallMap> map;
  Line line = nullptr;
};

/// The config, its map or those that the scans choose from, and a pipeline for them.
struct Loaded {
  settings::Config config;
  std::vector<LoadedMap> maps;
  std::unique_ptr<core::Pipeline> pipeline;
};

/// "hall, 12 walls, SHA-256 3f0c...", for the log; "one of: hall, cellar" for several.
std::string describe(const core::WallMap& map);
std::string describe(const std::vector<LoadedMap>& maps);
/// Warns in the log of maps that are probably in other units, or twice the same; they are loaded
/// all the same.
void log_doubts(const Loaded& loaded);

/// Loads what a pipeline needs. Takes seconds where the map is large. Throws SettingsError where
/// config or map is invalid; the next load is then the same as without that call.
class MapLoader {
 public:
  /// `overrides`: "/json/pointer=value".
  MapLoader(std::filesystem::path config_file, std::vector<std::string> overrides);

  /// Reads the config and its maps, and throws what is wrong with them. Returns warnings.
  std::vector<std::string> check() const;
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
