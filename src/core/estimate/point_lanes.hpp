// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// What the points of one face add to a fit of the lidar's pose: sums over the points that are not
/// cut off, of their weights, levers (how far a small turn of the lidar moves them towards the
/// face) and distances.
struct FaceSums {
  double weight = 0;
  double lever = 0;  ///< each times the point's weight, as those that follow
  double lever_squared = 0;
  double distance = 0;
  double distance_lever = 0;
  double z_squared = 0;   ///< squared distances by their variances; without weights, like the rest
  double squared_m2 = 0;  ///< squared distances
  double points = 0;
};

/// The returns of a turn side by side, for sums over many of them: in single precision, four at a
/// time. A Cortex-A8 multiplies doubles in 17 cycles each and four floats in two. At 10 m a float
/// is good to a micrometre, a thousandth of what the lidar is.
class PointLanes {
 public:
  /// Beyond this many standard deviations from its face a point pulls at nothing.
  static constexpr double kCutSigmas = 4;

  /// Takes all its memory.
  PointLanes();

  void assign(std::span<const PolarPoint> points, const SensorNoise& noise, double noise_scale);

  /// Of the points from `begin` to before `end`, which meet one face: its normal, and how far the
  /// lidar is in front of it, in the lidar's frame. Weights are Tukey's biweight: full at the wall,
  /// none at the cut. `slack_m`: a standard deviation on top of each point's own.
  FaceSums sum(std::size_t begin, std::size_t end, const Vec2& normal, double height_m,
               double slack_m) const;

 private:
  std::vector<float> x_m_;
  std::vector<float> y_m_;
  std::vector<float> inverse_range_;
  std::vector<float> across_m2_;  ///< variance of the distance to a wall that the ray grazes
  std::vector<float> along_m2_;   ///< what is added to it where the ray meets the wall squarely
};

}  // namespace cornerd::core
