// SPDX-License-Identifier: MIT
#include "daemon/map_loader.hpp"

#include <utility>

#include "daemon/log.hpp"
#include "message/line_writer.hpp"
#include "settings/config_warnings.hpp"
#include "settings/document.hpp"
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

/// Those that scans are localized in.
std::vector<settings::NamedMap> used_maps(const settings::Config& config,
                                          const std::filesystem::path& config_file) {
  if (!config.chooses_map()) return {{config.map_name, config.map}};
  if (config.maps.size() > core::MapChoice::kMaxMaps) {
    throw settings::SettingsError(
        config_file, "/maps",
        "\"auto\" chooses from at most " + std::to_string(core::MapChoice::kMaxMaps));
  }
  return config.maps;
}

}  // namespace

std::string describe(const core::WallMap& map) {
  const core::FloorPlan& plan = map.plan();
  return plan.name + ", " + std::to_string(plan.walls.size()) + " walls, SHA-256 " + plan.hash;
}

std::string describe(const std::vector<LoadedMap>& maps) {
  if (maps.size() == 1) return describe(*maps.front().map);
  std::string names;
  for (const LoadedMap& loaded : maps) {
    names += (names.empty() ? "one of: " : ", ") + loaded.map->plan().name;
  }
  return names;
}

void log_doubts(const Loaded& loaded) {
  for (const LoadedMap& one : loaded.maps) {
    const std::string warning = settings::size_warning(*one.map);
    if (!warning.empty()) log(LogLevel::kWarning, one.map->plan().name + ": " + warning);
  }
  for (const std::string& warning : settings::warnings_of(loaded.config)) {
    log(LogLevel::kWarning, warning);
  }
}

MapLoader::MapLoader(std::filesystem::path config_file, std::vector<std::string> overrides)
    : config_file_(std::move(config_file)), overrides_(std::move(overrides)) {}

std::vector<std::string> MapLoader::check() const {
  const settings::Config config = settings::load_config(config_file_, overrides_, kKind);
  for (const settings::NamedMap& map : used_maps(config, config_file_)) {
    settings::load_map(map.file, kKind);
  }
  for (const settings::NamedMap& map : config.maps) {
    if (!config.chooses_map() && map.file != config.map) settings::load_map(map.file, kKind);
  }
  return settings::warnings_of(config);
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
  std::vector<std::shared_ptr<const core::WallMap>> maps;
  for (const settings::NamedMap& map : used_maps(config, config_file_)) {
    maps.push_back(settings::load_map(map.file, kKind, map.name));
    loaded.maps.push_back({maps.back(), std::make_shared<const std::string>(
                                            message::LineWriter().map(maps.back()->plan()))});
  }
  loaded.pipeline = std::make_unique<core::Pipeline>(maps, localizer_config(config));
  used_ = config;
  loaded.config = std::move(config);
  return loaded;
}

}  // namespace cornerd::daemon
