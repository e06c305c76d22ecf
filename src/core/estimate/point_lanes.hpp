// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/estimate/line_sums.hpp"
#include "core/geometry/pose2.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Contribution of one face's points to the normal equations: sums over the points within the cut.
struct FaceSums : LineSums {
  /// As LineSums::move(). Of `squared_distances` alone it is an approximation: their mean distance
  /// is taken for 0, and no angle.
  void move(double offset_m, double angle_rad, double lever_m) {
    const LineSums before = *this;
    LineSums::move(offset_m, angle_rad, lever_m);
    const double intercept_m = offset_m - angle_rad * lever_m;
    z_squared += intercept_m * (before.distance + distance) +
                 angle_rad * (before.distance_lever + distance_lever);
    squared_distances += offset_m * offset_m * points;
  }

  double z_squared = 0;  ///< sum of squared distances over variances, unweighted like the rest;
                         ///< weighted where the face has an offset of its own
  double squared_distances = 0;  ///< m^2
  double points = 0;
};

/// The points of a scan as structure of arrays in single precision, summed four at a time. A
/// Cortex-A8 multiplies doubles in 17 cycles each and four floats in two (tests/arm/cost). A float
/// resolves a micrometre at 10 m.
class PointLanes {
 public:
  /// A point farther from its face has no weight.
  static constexpr double kCutSigmas = 4;

  /// Takes all memory.
  PointLanes();

  void assign(std::span<const PolarPoint> points, const SensorNoise& noise, double noise_scale);

  /// Sums over the points [begin, end), which all hit one face. `normal`: of the face; `height_m`:
  /// distance of the lidar in front of it, lidar frame. Weights are Tukey's biweight over the
  /// variance. `extra_sigma_m` is added to each point's noise (graduated non-convexity);
  /// `face_sigma_m`, of the face's own offset, widens the cut alone. Distances are less by
  /// `angle_rad` a lever: those to a plane that is turned to the left about the lidar's foot.
  FaceSums sum(std::size_t begin, std::size_t end, const Vec2& normal, double height_m,
               double extra_sigma_m, double face_sigma_m = 0, double angle_rad = 0) const;

 private:
  std::vector<float> x_m_;
  std::vector<float> y_m_;
  std::vector<float> inverse_range_;
  std::vector<float> across_variance_;  ///< of the distance to a wall at grazing incidence, m^2
  std::vector<float> along_variance_;   ///< added to it at normal incidence, m^2
};

}  // namespace cornerd::core
