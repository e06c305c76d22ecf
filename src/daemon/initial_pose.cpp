// SPDX-License-Identifier: MIT
#include "daemon/initial_pose.hpp"

#include <array>
#include <cstdio>

#include "calibration/fault_list.hpp"

namespace cornerd::daemon {

std::optional<message::RequestError> outside_of(const core::WallMap* map,
                                                const core::Pose2& T_map_base) {
  if (map == nullptr) {
    return message::RequestError{
        "map", "it is not known yet which of the maps the robot is in: name one with SET_MAP"};
  }
  const core::Vec2 low = map->lower_left();
  const core::Vec2 high = map->upper_right();
  if (!calibration::is_outside(*map, T_map_base.translation())) return std::nullopt;
  std::array<char, 160> extent{};
  std::snprintf(extent.data(), extent.size(),
                "\" has walls from %.2f to %.2f m in x and from %.2f to %.2f m in y", low.x(),
                high.x(), low.y(), high.y());
  return message::RequestError{
      "outside", "the pose is outside of the map: \"" + map->plan().name + extent.data()};
}

}  // namespace cornerd::daemon
