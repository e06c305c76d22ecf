// SPDX-License-Identifier: MIT
#include "replay/simulator/doors.hpp"

#include <algorithm>
#include <utility>

namespace cornerd::replay {
namespace {

using core::Vec2;

constexpr double kMinDoor_m = 0.3;
constexpr double kMaxDoor_m = 1.2;

}  // namespace

std::vector<core::Wall> doors_of(const core::WallMap& map) {
  std::vector<core::Wall> doors;
  for (const core::Wall& wall : map.plan().walls) {
    for (const auto& [from, to] : {std::pair(wall.from, wall.to), {wall.to, wall.from}}) {
      const Vec2 along = (to - from).normalized();
      const Vec2 beyond = to + (wall.thickness_m / 2 + 1e-3) * along;
      if (map.is_solid(beyond)) continue;
      const double open_m = map.range_along(beyond, core::angle_of(along), kMaxDoor_m);
      if (open_m < kMinDoor_m) continue;
      // A door between two wall ends is found from both.
      const core::Wall door{to, beyond + open_m * along, wall.thickness_m};
      const bool known = std::any_of(doors.begin(), doors.end(), [&](const core::Wall& other) {
        constexpr double kSame_m = 0.15;
        return (other.from + other.to - door.from - door.to).norm() / 2 < kSame_m;
      });
      if (!known) doors.push_back(door);
    }
  }
  return doors;
}

}  // namespace cornerd::replay
