// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "replay/simulator/scene.hpp"

namespace cornerd::replay {

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
