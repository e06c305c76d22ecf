// SPDX-License-Identifier: MIT
#include "replay/simulator/clutter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/map/outline.hpp"
#include "replay/simulator/doors.hpp"
#include "replay/simulator/random.hpp"
#include "replay/simulator/random_poses.hpp"

namespace cornerd::replay {
namespace {

using core::Vec2;

/// Rays of a full revolution that estimate the share of stopped ones.
constexpr double kRaysPerRevolution = 360;
/// An obstacle that would exceed the share by more is not placed.
constexpr double kMaxExcess = 0.02;
/// The search ends after so many obstacles in succession that do not fit.
constexpr int kMaxTries = 1000;

/// A solid of `length_m` along a unit vector and `width_m` across, not longer.
core::Wall solid(const Vec2& centre, const Vec2& along, double length_m, double width_m) {
  const Vec2 half = (length_m - width_m) / 2 * along;
  return {centre - half, centre + half, width_m};
}

double distance_to(const core::WallBox& box, const Vec2& point) {
  const Vec2 local = box.to_local(point).cwiseAbs();
  return Vec2(std::max(0.0, local.x() - box.half_length_m),
              std::max(0.0, local.y() - box.half_width_m))
      .norm();
}

class Placement {
 public:
  Placement(const core::WallMap& world, const ScannedPath& path, const SensorModel& sensor,
            std::uint64_t seed)
      : world_(world), path_(path), doors_(doors_of(world)), random_(seed) {
    const FieldOfView& view = sensor.field_of_view;
    const int count =
        std::max(1, static_cast<int>(kRaysPerRevolution * view.width_rad / core::kTwoPi));
    for (const core::Pose2& pose : path.T_map_lidar) {
      for (int i = 0; i < count; ++i) {
        const double angle_rad =
            pose.theta_rad + view.centre_rad + view.width_rad * ((i + 0.5) / count - 0.5);
        const double range_m = world.range_along(pose.translation(), angle_rad, sensor.max_range_m);
        rays_.push_back({pose.translation(), core::unit_vector(angle_rad), angle_rad,
                         range_m > 0 ? range_m : sensor.max_range_m, false});
      }
    }
  }

  /// Places obstacles until `share` is reached or none fits.
  Clutter fill(double share) {
    Clutter clutter;
    for (int tries = 0; clutter.share < share && tries < kMaxTries; ++tries) {
      const std::vector<core::Wall> obstacle = draw();
      if (obstacle.empty() || !is_clear_of_path(obstacle)) continue;
      const std::vector<Hit> hits = hits_of(obstacle);
      const auto added = std::count_if(hits.begin(), hits.end(),
                                       [&](const Hit& hit) { return !rays_[hit.ray].stopped; });
      const double reached =
          static_cast<double>(stopped_ + added) / static_cast<double>(rays_.size());
      if (added == 0 || reached > share + kMaxExcess) continue;
      for (const Hit& hit : hits) {
        rays_[hit.ray].free_m = hit.range_m;
        rays_[hit.ray].stopped = true;
      }
      stopped_ += added;
      clutter.walls.insert(clutter.walls.end(), obstacle.begin(), obstacle.end());
      ++clutter.obstacles;
      clutter.share = reached;
      tries = 0;
    }
    return clutter;
  }

 private:
  struct Ray {
    Vec2 origin;
    Vec2 direction;
    double angle_rad;
    double free_m;  ///< to the first wall or obstacle, at most the sensor's maximum range
    bool stopped;   ///< by an obstacle
  };
  struct Hit {
    std::size_t ray;
    double range_m;
  };

  /// A random obstacle within sight; empty if it does not fit between the walls.
  std::vector<core::Wall> draw() {
    const double kind = random_.uniform();
    if (kind < 0.1 && !doors_.empty()) {
      std::swap(doors_[random_.bits() % doors_.size()], doors_.back());
      const core::Wall door = doors_.back();
      doors_.pop_back();
      return {door};
    }
    const Ray& ray = rays_[random_.bits() % rays_.size()];
    const Vec2 centre = ray.origin + random_.uniform(0, ray.free_m) * ray.direction;
    // Furniture stands parallel to walls.
    const Vec2 along = world_.faces()[random_.bits() % world_.faces().size()].direction;
    const Vec2 across = core::rotate_left(along);
    std::vector<core::Wall> obstacle;
    if (kind < 0.4) {  // a post
      const double width_m = random_.uniform(0.03, 0.3);
      obstacle = {solid(centre, core::unit_vector(random_.uniform(0, core::kTwoPi)), 1.1 * width_m,
                        width_m)};
    } else if (kind < 0.7) {  // the legs of a chair or table
      const double leg_m = random_.uniform(0.02, 0.06);
      const Vec2 half_length = random_.uniform(0.35, 1.4) / 2 * along;
      const Vec2 half_width = random_.uniform(0.35, 0.8) / 2 * across;
      for (const Vec2& corner : {Vec2(half_length + half_width), Vec2(half_length - half_width),
                                 Vec2(half_width - half_length), Vec2(-half_length - half_width)}) {
        obstacle.push_back(solid(centre + corner, along, 1.1 * leg_m, leg_m));
      }
    } else {  // a box
      const double width_m = random_.uniform(0.15, 0.5);
      obstacle = {solid(centre, along, width_m + random_.uniform(0.02, 0.6), width_m)};
    }
    return std::all_of(obstacle.begin(), obstacle.end(),
                       [&](const core::Wall& wall) { return is_in_free_space(wall); })
               ? obstacle
               : std::vector<core::Wall>();
  }

  bool is_in_free_space(const core::Wall& wall) const {
    const core::WallBox box(wall);
    return !world_.is_solid(box.centre) &&
           clearance_at(world_, box.centre) > std::hypot(box.half_length_m, box.half_width_m);
  }

  bool is_clear_of_path(const std::vector<core::Wall>& obstacle) const {
    return std::all_of(obstacle.begin(), obstacle.end(), [&](const core::Wall& wall) {
      const core::WallBox box(wall);
      return std::all_of(path_.points.begin(), path_.points.end(), [&](const Vec2& point) {
        return distance_to(box, point) >= kClutterClearance_m;
      });
    });
  }

  /// Rays that the obstacle stops before what stops them now.
  std::vector<Hit> hits_of(const std::vector<core::Wall>& obstacle) const {
    core::FloorPlan plan;
    plan.walls = obstacle;
    const core::WallMap solids(plan);
    const Vec2 centre = (solids.lower_left() + solids.upper_right()) / 2;
    const double radius_m = (solids.upper_right() - solids.lower_left()).norm() / 2;
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Ray& ray = rays_[i];
      const Vec2 to = centre - ray.origin;
      const double along_m = to.dot(ray.direction);
      if (along_m < -radius_m || along_m - radius_m > ray.free_m) continue;
      if (std::abs(core::cross(ray.direction, to)) > radius_m) continue;
      const double range_m = solids.range_along(ray.origin, ray.angle_rad, ray.free_m);
      if (range_m > 0) hits.push_back({i, range_m});
    }
    return hits;
  }

  const core::WallMap& world_;
  const ScannedPath& path_;
  std::vector<core::Wall> doors_;  ///< not tried yet
  Random random_;
  std::vector<Ray> rays_;
  std::ptrdiff_t stopped_ = 0;
};

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

}  // namespace

Clutter place_clutter(const core::WallMap& world, const ScannedPath& path,
                      const SensorModel& sensor, double share, std::uint64_t seed) {
  if (!(share >= 0 && share <= 1)) throw std::invalid_argument("clutter: the share must be 0 to 1");
  if (path.T_map_lidar.empty()) throw std::invalid_argument("clutter: the path has no scans");
  const Clutter clutter = Placement(world, path, sensor, seed).fill(share);
  if (clutter.share < share) {
    throw std::runtime_error("clutter: " + std::to_string(clutter.obstacles) +
                             " unmapped obstacles stop " + percent(clutter.share) +
                             " of the rays, not " + percent(share) +
                             ", and no other fits 0.25 m beside the path; choose a smaller share");
  }
  return clutter;
}

}  // namespace cornerd::replay
