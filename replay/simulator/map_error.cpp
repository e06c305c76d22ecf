// SPDX-License-Identifier: MIT
#include "replay/simulator/map_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/map/outline.hpp"
#include "replay/simulator/random.hpp"

namespace cornerd::replay {
namespace {

using core::Vec2;

/// Rounding errors of walls drawn to each other.
constexpr double kTouching_m = 1e-3;
/// Below this sine of the angle between two walls, one does not bound the other's length.
constexpr double kMinSine = 0.3;

Vec2 normal_of(const core::Wall& wall) {
  const Vec2 along = wall.to - wall.from;
  return along.norm() > 0 ? core::rotate_left(along.normalized()) : Vec2::Zero();
}

bool touches(const core::WallBox& box, const Vec2& point, double half_thickness_m) {
  const Vec2 local = box.to_local(point).cwiseAbs();
  const double reach_m = half_thickness_m + kTouching_m;
  return local.x() <= box.half_length_m + reach_m && local.y() <= box.half_width_m + reach_m;
}

void check(double sigma_m) {
  if (!(sigma_m >= 0 && std::isfinite(sigma_m))) {
    throw std::invalid_argument("map error: the standard deviation must be 0 or more (m)");
  }
}

}  // namespace

core::Wall displaced(const core::Wall& wall, double by_m) {
  const Vec2 across = by_m * normal_of(wall);
  return {wall.from + across, wall.to + across, wall.thickness_m};
}

core::FloorPlan with_map_error(const core::FloorPlan& plan, double sigma_m, std::uint64_t seed) {
  check(sigma_m);
  Random random(seed);
  std::vector<double> by_m;
  for (std::size_t i = 0; i < plan.walls.size(); ++i) by_m.push_back(sigma_m * random.normal());
  return with_walls_moved(plan, by_m);
}

core::FloorPlan with_end_error(const core::FloorPlan& plan, double sigma_m, std::uint64_t seed) {
  check(sigma_m);
  Random random(seed);
  core::FloorPlan changed = plan;
  std::vector<std::pair<Vec2, Vec2>> moved;  // points, and by how much
  for (core::Wall& wall : changed.walls) {
    for (Vec2* end : {&wall.from, &wall.to}) {
      auto met = std::find_if(moved.begin(), moved.end(), [&](const auto& other) {
        return (other.first - *end).norm() < kTouching_m;
      });
      if (met == moved.end()) {
        const double x_m = sigma_m * random.normal();
        moved.emplace_back(*end, Vec2(x_m, sigma_m * random.normal()));
        met = moved.end() - 1;
      }
      *end += met->second;
    }
  }
  return changed;
}

core::FloorPlan with_walls_moved(const core::FloorPlan& plan, std::span<const double> by_m) {
  std::vector<core::WallBox> boxes(plan.walls.begin(), plan.walls.end());
  // Where the end of wall i touches wall j, it moves along wall i until it lies on the displaced
  // line of wall j: n_j . (by_i n_i + shift u_i) = by_j.
  const auto shift = [&](std::size_t i, const Vec2& end) -> Vec2 {
    const Vec2 normal = normal_of(plan.walls[i]);
    const Vec2 along = -core::rotate_left(normal);
    for (std::size_t j = 0; j < plan.walls.size(); ++j) {
      const Vec2 other = normal_of(plan.walls[j]);
      const double sine = other.dot(along);
      if (j == i || std::abs(sine) < kMinSine) continue;
      if (!touches(boxes[j], end, plan.walls[i].thickness_m / 2)) continue;
      return (by_m[j] - by_m[i] * other.dot(normal)) / sine * along;
    }
    return Vec2::Zero();
  };
  core::FloorPlan changed = plan;
  for (std::size_t i = 0; i < plan.walls.size(); ++i) {
    core::Wall& wall = changed.walls[i];
    const Vec2 across = by_m[i] * normal_of(plan.walls[i]);
    wall.from += across + shift(i, plan.walls[i].from);
    wall.to += across + shift(i, plan.walls[i].to);
  }
  return changed;
}

}  // namespace cornerd::replay
