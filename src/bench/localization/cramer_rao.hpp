// SPDX-License-Identifier: MIT
#pragma once

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::bench {

/// Cramer-Rao bound of the pose from one scan: no unbiased estimator has a smaller covariance.
/// Every return is modelled as normally distributed around the wall that its ray hits at the true
/// pose, with noise in range and bearing. Outliers would only raise the bound.
class CramerRao {
 public:
  CramerRao(const core::SensorNoise& noise, double max_range_m)
      : noise_(noise), prediction_(max_range_m) {}

  /// 3 x 3, of x, y (metres, map frame) and heading (radians). Zero where the scan's walls leave
  /// the pose unobservable.
  core::Covariance3 bound(const core::WallMap& map, const core::Pose2& T_map_lidar,
                          const core::PolarScan& scan);

 private:
  core::SensorNoise noise_;
  core::RayCaster prediction_;
};

}  // namespace cornerd::bench
