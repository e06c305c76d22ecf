// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/map/ray_caster.hpp"
#include "core/map/wall_map.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::bench {

/// Cramer-Rao bound of the pose from one scan: no unbiased estimator has a smaller covariance.
/// Every return is modelled as normally distributed around the wall that its ray hits at the true
/// pose, with noise in range and bearing. Outliers would only raise the bound. Where walls are off
/// it is that of all such buildings in the mean (the Bayesian one, van Trees 1968).
class CramerRao {
 public:
  /// `map_sigma_m`: standard deviation of each face's offset across itself, marginalised.
  CramerRao(const core::SensorNoise& noise, double max_range_m, double map_sigma_m = 0)
      : noise_(noise), prediction_(max_range_m), map_variance_m2_(map_sigma_m * map_sigma_m) {}

  /// 3 x 3, of x, y (metres, map frame) and heading (radians). Zero where the scan's walls leave
  /// the pose unobservable.
  core::Covariance3 bound(const core::WallMap& map, const core::Pose2& T_map_lidar,
                          const core::PolarScan& scan);

 private:
  struct FaceSums {
    double information = 0;                              ///< sum of 1 / variance
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  ///< sum of jacobian / variance
  };

  core::SensorNoise noise_;
  core::RayCaster prediction_;
  double map_variance_m2_;
  std::vector<FaceSums> faces_;  ///< by index into map.faces()
};

}  // namespace cornerd::bench
