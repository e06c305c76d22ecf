// SPDX-License-Identifier: MIT
#include "bench/drawn_plan.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/map/outline.hpp"
#include "replay/simulator/map_error.hpp"
#include "replay/simulator/random.hpp"
#include "replay/simulator/random_poses.hpp"

namespace cornerd::bench {
namespace {

using core::Vec2;

constexpr std::size_t kWallsPerMissing = 15;
constexpr double kInventedLength_m = 0.5;
constexpr double kInventedThickness_m = 0.1;
/// The screen stands away from walls, so that it hides none of them.
constexpr double kInventedClearance_m = 0.3;
constexpr double kDriveClearance_m = 0.2;
constexpr double kShortestLeg_m = 0.4;
constexpr double kCheckEvery_m = 0.05;
constexpr int kTries = 20'000;
constexpr int kTriesOfAPlace = 2'000;
constexpr double kTouching_m = 0.02;

bool is_free(const std::vector<core::Wall>& walls, std::size_t own, const Vec2& end) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (i == own) continue;
    const core::WallBox box(walls[i]);
    const Vec2 local = box.to_local(end).cwiseAbs();
    const double reach_m = walls[own].thickness_m / 2 + kTouching_m;
    if (local.x() < box.half_length_m + reach_m && local.y() < box.half_width_m + reach_m) {
      return false;
    }
  }
  return true;
}

bool is_clear(const core::WallMap& map, const Vec2& from, const Vec2& to, double clearance_m) {
  const int steps = static_cast<int>((to - from).norm() / kCheckEvery_m) + 1;
  for (int k = 0; k <= steps; ++k) {
    const Vec2 at = from + (to - from) * (static_cast<double>(k) / steps);
    if (map.is_solid(at) || replay::clearance_at(map, at) < clearance_m) return false;
  }
  return true;
}

core::Wall invented_wall(const core::WallMap& building, std::uint64_t seed) {
  for (const core::Pose2& pose :
       replay::random_poses(building, kTries / 100, kInventedClearance_m, seed)) {
    const Vec2 half = kInventedLength_m / 2 * Vec2::UnitX();
    for (const Vec2& to : {half, Vec2(core::rotate_left(half))}) {
      const core::Wall wall{pose.translation() - to, pose.translation() + to, kInventedThickness_m};
      if (is_clear(building, wall.from, wall.to, kInventedClearance_m / 2)) return wall;
    }
  }
  throw std::runtime_error("drawn_plan: no room for a wall that is not there");
}

}  // namespace

core::FloorPlan drawn_plan(const core::FloorPlan& building, std::uint64_t seed) {
  replay::Random random(seed);
  core::FloorPlan plan = replay::with_map_error(building, kDrawnAcross_m, seed);
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    const core::Wall& built = building.walls[i];
    const Vec2 along = (built.to - built.from).normalized();
    const double from_m = kDrawnAlong_m * random.normal();
    const double to_m = kDrawnAlong_m * random.normal();
    if (is_free(building.walls, i, built.from)) plan.walls[i].from += from_m * along;
    if (is_free(building.walls, i, built.to)) plan.walls[i].to += to_m * along;
  }
  for (std::size_t k = building.walls.size() / kWallsPerMissing; k > 0; --k) {
    const auto missing = random.uniform(0, static_cast<double>(plan.walls.size()));
    plan.walls.erase(plan.walls.begin() + static_cast<std::ptrdiff_t>(missing));
  }
  plan.walls.push_back(invented_wall(core::WallMap(building), seed));
  plan.sigma_m = kDrawnAcross_m;
  return plan;
}

std::vector<Vec2> random_drive(const core::WallMap& building, double length_m, std::uint64_t seed) {
  const auto places = replay::random_poses(building, kTries / 10, kDriveClearance_m, seed);
  std::vector<Vec2> path = {places.front().translation()};
  replay::Random random(seed);
  double driven_m = 0;
  for (int k = 0, last = 0; k < kTries; ++k) {
    if (k - last == kTriesOfAPlace) {  // shut in: from somewhere else
      last = k;
      driven_m = 0;
      path = {places[random.bits() % places.size()].translation()};
    }
    const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(places.size())));
    const Vec2 next = places[at].translation();
    const double leg_m = (next - path.back()).norm();
    if (leg_m < kShortestLeg_m || !is_clear(building, path.back(), next, kDriveClearance_m)) {
      continue;
    }
    path.push_back(next);
    last = k;
    driven_m += leg_m;
    if (driven_m >= length_m) return path;
  }
  throw std::runtime_error("random_drive: no room for it");
}

}  // namespace cornerd::bench
