// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "core/map/ray_caster.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// How well a place explains a turn, ray by ray.
struct Explanation {
  std::size_t rays = 0;
  std::size_t hits = 0;  ///< met the wall that the map has there
  std::size_t near = 0;  ///< met something close to it: a wall that is not quite where it should be
  std::size_t shorts = 0;   ///< something that the map does not have stood in front of the wall
  std::size_t through = 0;  ///< went through a wall of the map
  double log_likelihood = 0;
  /// The same, but what hides many rays in a row counts once: it is one thing, near or large.
  double log_likelihood_of_things = 0;

  double hit_share() const { return share(hits); }
  double near_share() const { return share(hits + near); }
  double through_share() const { return share(through); }

 private:
  double share(std::size_t count) const {
    return rays == 0 ? 0 : static_cast<double>(count) / static_cast<double>(rays);
  }
};

/// `slack_m`: what a predicted range may be off because the place is not known exactly yet.
Explanation explain(const WallMap& map, std::span<const PolarPoint> points,
                    std::span<const PredictedHit> hits, const Pose2& T_map_lidar,
                    const SensorNoise& noise, double noise_scale, double slack_m);

}  // namespace cornerd::core
