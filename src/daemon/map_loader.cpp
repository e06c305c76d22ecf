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
  std::string text = settings::read_file(config_file_, settings::kMaxConfigBytes, kKind);
  text_.swap(text);
  try {
    Loaded loaded = with_map(parse());
    config_ = loaded.config;
    return loaded;
  } catch (...) {
    text_.swap(text);
    throw;
  }
}

settings::Config MapLoader::parse() const {
  return settings::parse_config(text_, config_file_, overrides_, /*require_map=*/true, model_);
}

Loaded MapLoader::load(const drivers::LidarModel& model) {
  model_ = &model;
  const core::SensorNoise& noise = parse().lidar.noise.sensor;
  const core::SensorNoise& before = config_.lidar.noise.sensor;
  Loaded loaded;
  if (noise.floor_m == before.floor_m && noise.share == before.share &&
      noise.bearing_rad == before.bearing_rad) {
    return loaded;
  }
  config_.lidar.noise.sensor = noise;
  used_.lidar.noise.sensor = noise;
  return with_map(used_);
}

Loaded MapLoader::load(const message::SetMapRequest& request) {
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
  used_ = config;
  loaded.config = std::move(config);
  return loaded;
}

}  // namespace cornerd::daemon
