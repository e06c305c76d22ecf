// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "core/map/ray_caster.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Likelihood of a scan at a pose in an exact map, ray by ray, by the beam model (Thrun, Burgard
/// and Fox, Probabilistic Robotics, section 6.3).
struct BeamLikelihood {
  std::size_t rays = 0;
  std::size_t hits = 0;                   ///< at the predicted range
  std::size_t near_hits = 0;              ///< close to it: a wall slightly displaced
  std::size_t shorts = 0;                 ///< short of the wall: an unmapped obstacle
  std::size_t free_space_violations = 0;  ///< beyond the wall
  double log_likelihood = 0;

  double hit_share() const { return share(hits); }
  double near_hit_share() const { return share(hits + near_hits); }
  double violation_share() const { return share(free_space_violations); }

  /// Enough rays are on walls, and hardly any goes through one, for the place to be the right one.
  bool explains_scan() const;
  /// Hardly any ray is left for a competing place. `expected`: near the prior, where unmapped
  /// obstacles may take a larger share.
  bool is_conclusive(bool expected) const;

 private:
  double share(std::size_t count) const {
    return rays == 0 ? 0 : static_cast<double>(count) / static_cast<double>(rays);
  }
};

/// `hits`: the face that each point's ray meets at `T_map_lidar`, by RayCaster.
BeamLikelihood beam_likelihood(const WallMap& map, std::span<const PolarPoint> points,
                               std::span<const PredictedHit> hits, const Pose2& T_map_lidar,
                               const SensorNoise& noise, double noise_scale);

}  // namespace cornerd::core
