// SPDX-License-Identifier: MIT
// The surroundings that a simulated lidar measures.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/geometry/pose2.hpp"
#include "core/map/wall_map.hpp"
#include "core/types.hpp"
#include "replay/simulator/motion.hpp"

namespace cornerd::replay {

class Scene {
 public:
  virtual ~Scene() = default;

  /// Distance along a ray in the lidar frame; 0: no wall. Times and scans of successive calls do
  /// not decrease.
  virtual double range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                             double bearing_rad) = 0;
};

/// The walls of a map, seen from a moving robot.
class MapScene : public Scene {
 public:
  MapScene(std::shared_ptr<const core::WallMap> map, Motion motion,
           const core::Pose2& T_base_lidar = {});

  double range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                     double bearing_rad) override;

  /// The true pose.
  core::Pose2 T_map_base(core::TimeNs t_ns, std::int64_t scan) const { return motion_(t_ns, scan); }

 private:
  std::shared_ptr<const core::WallMap> map_;
  Motion motion_;
  core::Pose2 T_base_lidar_;
};

/// A scene that any thread can cover, as if the laser were covered or dead.
class CoverableScene : public Scene {
 public:
  explicit CoverableScene(std::unique_ptr<Scene> scene) : scene_(std::move(scene)) {}

  void cover(bool covered) { covered_.store(covered, std::memory_order_relaxed); }

  double range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                     double bearing_rad) override {
    const double range_m = scene_->range_along(t_ns, scan, origin, bearing_rad);
    return covered_.load(std::memory_order_relaxed) ? 0 : range_m;
  }

 private:
  std::unique_ptr<Scene> scene_;
  std::atomic<bool> covered_{false};
};

}  // namespace cornerd::replay
