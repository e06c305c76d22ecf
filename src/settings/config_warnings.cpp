// SPDX-License-Identifier: MIT
#include "settings/config_warnings.hpp"

#include <cmath>

#include "settings/map_choice.hpp"
#include "settings/object_reader.hpp"

namespace cornerd::settings {
namespace {

/// Small robots are no larger: beyond it centimetres were meant.
constexpr double kFarMount_m = 1;

}  // namespace

std::vector<std::string> warnings_of(const Config& config) {
  std::vector<std::string> warnings;
  const MountConfig& mount = config.lidar.mount;
  if (std::hypot(mount.x_m, mount.y_m) > kFarMount_m) {
    warnings.push_back("/lidar/mount: x = " + to_text(mount.x_m) + ", y = " + to_text(mount.y_m) +
                       " is far off the middle of the axle: is it in metres?");
  }
  const std::string equal_maps = equal_maps_warning(config);
  if (!equal_maps.empty()) warnings.push_back(equal_maps);
  return warnings;
}

}  // namespace cornerd::settings
