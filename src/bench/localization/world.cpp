// SPDX-License-Identifier: MIT
#include "bench/localization/world.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::bench {
namespace {

using core::Vec2;

constexpr double kMinDoor_m = 0.3;
constexpr double kMaxDoor_m = 1.2;
constexpr double kWorldSight_m = 100;
/// Rays by which the share of a turn is judged.
constexpr int kClutterRays = 360;

double share_stopped(const core::WallMap& map, const Vec2& place,
                     const std::vector<RoundThing>& things) {
  int stopped = 0;
  for (int i = 0; i < kClutterRays; ++i) {
    const double angle_rad = core::kTwoPi * i / kClutterRays;
    const double range_m = map.range_along(place, angle_rad, kWorldSight_m);
    stopped += range_with(things, place, angle_rad, range_m) < range_m ? 1 : 0;
  }
  return static_cast<double>(stopped) / kClutterRays;
}

}  // namespace

double range_with(const std::vector<RoundThing>& things, const Vec2& origin, double angle_rad,
                  double range_m) {
  const Vec2 ray = core::unit_vector(angle_rad);
  for (const RoundThing& thing : things) {
    const Vec2 to = thing.centre - origin;
    const double along_m = to.dot(ray);
    const double aside_m = core::cross(ray, to);
    if (along_m <= 0 || std::abs(aside_m) >= thing.radius_m) continue;
    const double hit_m = along_m - std::sqrt(thing.radius_m * thing.radius_m - aside_m * aside_m);
    if (hit_m > 0 && (range_m == 0 || hit_m < range_m)) range_m = hit_m;
  }
  return range_m;
}

std::vector<RoundThing> clutter_around(const core::WallMap& map, const Vec2& place, double share,
                                       replay::Random& random) {
  constexpr double kNearest_m = 0.25;
  constexpr double kSmallest_m = 0.02;  // a chair's leg
  constexpr double kLargest_m = 0.2;    // a person
  std::vector<RoundThing> things;
  while (share_stopped(map, place, things) < share) {
    const double angle_rad = random.uniform(0, core::kTwoPi);
    const double range_m = map.range_along(place, angle_rad, kWorldSight_m);
    const double radius_m = random.uniform(kSmallest_m, kLargest_m);
    const double centre_m = random.uniform(kNearest_m, std::max(kNearest_m, range_m));
    if (centre_m - radius_m < kNearest_m / 2) continue;
    things.push_back({place + centre_m * core::unit_vector(angle_rad), radius_m});
  }
  return things;
}

std::vector<core::Wall> doors_of(const core::WallMap& map) {
  std::vector<core::Wall> doors;
  for (const core::Wall& wall : map.plan().walls) {
    for (const auto& [from, to] : {std::pair(wall.from, wall.to), {wall.to, wall.from}}) {
      const Vec2 along = (to - from).normalized();
      const Vec2 beyond = to + (wall.thickness_m / 2 + 1e-3) * along;
      if (map.is_solid(beyond)) continue;
      const double open_m = map.range_along(beyond, core::angle_of(along), kMaxDoor_m);
      if (open_m < kMinDoor_m) continue;
      // A door between two ends is found from both.
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

std::vector<core::FloorPlan> with_a_door_closed(const core::WallMap& map) {
  std::vector<core::FloorPlan> plans;
  for (const core::Wall& door : doors_of(map)) {
    plans.push_back(map.plan());
    plans.back().walls.push_back(door);
  }
  return plans;
}

std::vector<core::FloorPlan> with_a_wall_displaced(const core::WallMap& map, double by_m) {
  std::vector<core::FloorPlan> plans;
  for (std::size_t i = 0; i < map.plan().walls.size(); ++i) {
    plans.push_back(map.plan());
    core::Wall& wall = plans.back().walls[i];
    const Vec2 across = by_m * core::rotate_left((wall.to - wall.from).normalized());
    wall.from += across;
    wall.to += across;
  }
  return plans;
}

}  // namespace cornerd::bench
