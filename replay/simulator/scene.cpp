// SPDX-License-Identifier: MIT
#include "replay/simulator/scene.hpp"

#include <utility>

namespace cornerd::replay {
namespace {

/// Beyond any lidar of this family; SensorModel has the sensor's own limit.
constexpr double kMaxRangeM = 100;

}  // namespace

MapScene::MapScene(std::shared_ptr<const core::WallMap> map, Motion motion,
                   const core::Pose2& T_base_lidar)
    : map_(std::move(map)), motion_(std::move(motion)), T_base_lidar_(T_base_lidar) {}

double MapScene::range_along(core::TimeNs t_ns, std::int64_t scan, const core::Vec2& origin,
                             double bearing_rad) {
  const core::Pose2 T_map_lidar = motion_(t_ns, scan) * T_base_lidar_;
  return map_->range_along(T_map_lidar * origin, T_map_lidar.theta_rad + bearing_rad, kMaxRangeM);
}

}  // namespace cornerd::replay
