// SPDX-License-Identifier: MIT
#include "bench/localization/world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "replay/simulator/doors.hpp"
#include "replay/simulator/map_error.hpp"
#include "replay/simulator/random_poses.hpp"

namespace cornerd::bench {
namespace {

using core::Vec2;

constexpr double kWorldRange_m = 100;
/// Rays that estimate the share of stopped ones.
constexpr int kClutterRays = 360;

double share_stopped(const core::WallMap& map, const Vec2& place,
                     const std::vector<RoundObstacle>& obstacles) {
  int stopped = 0;
  for (int i = 0; i < kClutterRays; ++i) {
    const double angle_rad = core::kTwoPi * i / kClutterRays;
    const double range_m = map.range_along(place, angle_rad, kWorldRange_m);
    stopped += range_with_obstacles(obstacles, place, angle_rad, range_m) < range_m ? 1 : 0;
  }
  return static_cast<double>(stopped) / kClutterRays;
}

}  // namespace

double range_with_obstacles(const std::vector<RoundObstacle>& obstacles, const Vec2& origin,
                            double angle_rad, double range_m) {
  const Vec2 ray = core::unit_vector(angle_rad);
  for (const RoundObstacle& obstacle : obstacles) {
    const Vec2 to = obstacle.centre - origin;
    const double along_m = to.dot(ray);
    const double aside_m = core::cross(ray, to);
    if (along_m <= 0 || std::abs(aside_m) >= obstacle.radius_m) continue;
    const double hit_m =
        along_m - std::sqrt(obstacle.radius_m * obstacle.radius_m - aside_m * aside_m);
    if (hit_m > 0 && (range_m == 0 || hit_m < range_m)) range_m = hit_m;
  }
  return range_m;
}

std::vector<RoundObstacle> clutter_around(const core::WallMap& map, const Vec2& place, double share,
                                          replay::Random& random) {
  constexpr double kNearest_m = 0.25;
  constexpr double kSmallest_m = 0.02;  // a chair's leg
  constexpr double kLargest_m = 0.2;    // a person
  constexpr int kMostTries = 1000;
  std::vector<RoundObstacle> obstacles;
  for (int k = 0; k < kMostTries && share_stopped(map, place, obstacles) < share; ++k) {
    const double angle_rad = random.uniform(0, core::kTwoPi);
    const double range_m = map.range_along(place, angle_rad, kWorldRange_m);
    const double radius_m = random.uniform(kSmallest_m, kLargest_m);
    const double centre_m = random.uniform(kNearest_m, std::max(kNearest_m, range_m));
    if (centre_m - radius_m < kNearest_m / 2) continue;
    obstacles.push_back({place + centre_m * core::unit_vector(angle_rad), radius_m});
  }
  return obstacles;
}

core::FloorPlan mirrored(core::FloorPlan plan) {
  for (core::Wall& wall : plan.walls) {
    wall.from.x() *= -1;
    wall.to.x() *= -1;
  }
  for (core::Room& room : plan.rooms) {
    for (core::Vec2& corner : room.polygon) corner.x() *= -1;
  }
  return plan;
}

std::vector<core::FloorPlan> with_a_door_closed(const core::WallMap& map) {
  std::vector<core::FloorPlan> plans;
  for (const core::Wall& door : replay::doors_of(map)) {
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
    wall = replay::displaced(wall, by_m);
  }
  return plans;
}

namespace {

constexpr double kCircleClearance_m = 0.15;
constexpr std::size_t kPosesAtOnce = 16;
constexpr std::size_t kMaxCircleTries = 500;

bool is_clear(const core::WallMap& world, const core::Vec2& centre, double radius_m) {
  // Closer than the clearance, so that no wall fits between two points.
  const int points = static_cast<int>(std::ceil(core::kTwoPi * radius_m / kCircleClearance_m)) + 1;
  for (int i = 0; i < points; ++i) {
    const double angle_rad = core::kTwoPi * i / points;
    const core::Vec2 point = centre + radius_m * core::unit_vector(angle_rad);
    if (world.is_solid(point)) return false;
    if (replay::clearance_at(world, point) < kCircleClearance_m) return false;
  }
  return true;
}

}  // namespace

replay::Motion circling(const core::Pose2& start, const CircularMotion& motion) {
  if (motion.yaw_rate_rad_s == 0) return replay::stand_still(start);
  return [start, motion](core::TimeNs t_ns, std::int64_t) {
    const double rotated_rad = motion.yaw_rate_rad_s * static_cast<double>(t_ns) * 1e-9;
    const double radius_m = motion.speed_m_s / motion.yaw_rate_rad_s;
    return start * core::Pose2{radius_m * std::sin(rotated_rad),
                               radius_m * (1 - std::cos(rotated_rad)),
                               core::normalize_angle(rotated_rad)};
  };
}

std::vector<core::Pose2> random_circles(const core::WallMap& world, const CircularMotion& motion,
                                        std::size_t count, std::uint64_t seed) {
  if (motion.yaw_rate_rad_s == 0) {
    return replay::random_poses(world, count, kCircleClearance_m, seed);
  }
  std::vector<core::Pose2> starts;
  const double radius_m = motion.speed_m_s / motion.yaw_rate_rad_s;
  for (std::size_t tries = 0; starts.size() < count; ++tries) {
    if (tries == kMaxCircleTries + count)
      throw std::runtime_error("no room for a circle of that size");
    for (const core::Pose2& place :
         replay::random_poses(world, kPosesAtOnce, kCircleClearance_m, seed + tries)) {
      if (starts.size() == count) break;
      if (is_clear(world, place * core::Vec2(0, radius_m), radius_m)) starts.push_back(place);
    }
  }
  return starts;
}

}  // namespace cornerd::bench
