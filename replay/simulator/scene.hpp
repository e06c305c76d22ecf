// SPDX-License-Identifier: MIT
// What a lidar sees, whatever it is made of.
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

  /// Distance along a ray in the lidar's frame; 0: nothing there. Times and turns of successive
  /// calls do not decrease.
  virtual double range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                             double bearing_rad) = 0;
};

/// A robot with a lidar among the walls of a map.
class MapScene : public Scene {
 public:
  MapScene(std::shared_ptr<const core::WallMap> map, Motion motion,
           const core::Pose2& T_base_lidar = {});

  double range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                     double bearing_rad) override;

  /// The truth: the pose of `base`.
  core::Pose2 T_map_base(core::TimeNs t_ns, std::int64_t scan) const { return motion_(t_ns, scan); }

 private:
  std::shared_ptr<const core::WallMap> map_;
  Motion motion_;
  core::Pose2 T_base_lidar_;
};

/// A scene that can be hidden from the lidar: as a covered or dead laser sees it. Any thread may
/// cover it.
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
