// SPDX-License-Identifier: MIT
#include "daemon/map_loader.hpp"

#include <utility>

#include "message/line_writer.hpp"
#include "settings/map_choice.hpp"
#include "settings/map_file.hpp"

namespace cornerd::daemon {
namespace {

/// Loading must not block on a pipe or a device.
constexpr auto kKind = settings::FileKind::kOrdinary;

core::LocalizerConfig localizer_config(const settings::Config& config) {
  core::LocalizerConfig localizer = config.localizer();
  // Tolerated clock difference between an ODOMETRY client and the daemon.
  constexpr double kClocks_s = 0.25;
  if (config.lidar.driver != settings::DriverKind::kReplay) {
    localizer.odometry.limits.ahead_s = kClocks_s;
  }
  return localizer;
}

}  // namespace

MapLoader::MapLoader(std::filesystem::path config_file, std::vector<std::string> overrides)
    : config_file_(std::move(config_file)), overrides_(std::move(overrides)) {}

void MapLoader::check() const {
  const settings::Config config = settings::load_config(config_file_, overrides_, kKind);
  settings::load_map(config.map, kKind);
  for (const settings::NamedMap& map : config.maps) {
    if (map.file != config.map) settings::load_map(map.file, kKind);
  }
}

Loaded MapLoader::load() {
  Loaded loaded = with_map(settings::load_config(config_file_, overrides_, kKind));
  config_ = loaded.config;
  return loaded;
}

Loaded MapLoader::load(const message::SetMapRequest& request) const {
  settings::Config config = config_;
  config.map_name = request.name;
  config.map = request.name.empty() ? settings::map_in_folders(config_, request.file)
                                    : settings::map_named(config_, request.name);
  return with_map(std::move(config));
}

Loaded MapLoader::with_map(settings::Config config) {
  Loaded loaded;
  loaded.map = settings::load_map(config.map, kKind, config.map_name);
  loaded.map_line =
      std::make_shared<const std::string>(message::LineWriter().map(loaded.map->plan()));
  loaded.pipeline = std::make_unique<core::Pipeline>(loaded.map, localizer_config(config));
  loaded.config = std::move(config);
  return loaded;
}

}  // namespace cornerd::daemon
