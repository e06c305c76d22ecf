// SPDX-License-Identifier: MIT
#pragma once

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::bench {

/// The Cramer-Rao bound of one turn: no unbiased estimator's covariance is less. It takes every
/// return for a normal one of the wall that its ray meets at the true place, its bearing uncertain
/// along with its range. Outliers, and what rays at corners lose, would only raise it.
class CramerRao {
 public:
  CramerRao(const core::SensorNoise& noise, double max_range_m)
      : noise_(noise), prediction_(max_range_m) {}

  /// Of x, y in metres in the map frame, and heading in radians. Zero where the turn's walls do
  /// not fix the pose.
  core::Covariance3 bound(const core::WallMap& map, const core::Pose2& T_map_lidar,
                          const core::PolarScan& scan);

 private:
  core::SensorNoise noise_;
  core::RayCaster prediction_;
};

}  // namespace cornerd::bench
