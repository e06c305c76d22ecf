// SPDX-License-Identifier: MIT
#include "daemon/initial_pose.hpp"

#include <array>
#include <cstdio>

namespace cornerd::daemon {

std::optional<message::RequestError> outside_of(const core::WallMap* map,
                                                const core::Pose2& T_map_base) {
  // A robot in front of the building's door is not lost.
  constexpr double kMargin_m = 1;
  if (map == nullptr) return std::nullopt;
  const core::Vec2 low = map->lower_left();
  const core::Vec2 high = map->upper_right();
  const core::Vec2 place = T_map_base.translation();
  if ((place - low).minCoeff() >= -kMargin_m && (high - place).minCoeff() >= -kMargin_m) {
    return std::nullopt;
  }
  std::array<char, 160> extent{};
  std::snprintf(extent.data(), extent.size(),
                "\" has walls from %.2f to %.2f m in x and from %.2f to %.2f m in y", low.x(),
                high.x(), low.y(), high.y());
  return message::RequestError{
      "outside", "the pose is outside of the map: \"" + map->plan().name + extent.data()};
}

}  // namespace cornerd::daemon
