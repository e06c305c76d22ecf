// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/estimate/constant_velocity_model.hpp"
#include "core/estimate/refinement.hpp"
#include "core/localizer_config.hpp"
#include "core/recognition/beam_model.hpp"

namespace cornerd::core {

/// A pose that was refined on all rays.
struct VerifiedHypothesis {
  RefinedPose refined;
  BeamCounts rays;         ///< of an exact map; of the likeliest one where it is not
  double evidence = 0;     ///< log_odds_of_place(), nats
  double log_odds = 0;     ///< against places that the scan leaves open, too
  double map_sigma_m = 0;  ///< of the walls' offsets, which `refined` marginalised
  bool is_exact = false;   ///< the rays hit walls where the map has them, within the noise
};

/// What is known before a scan.
struct ScanPrior {
  double noise_scale = 1;
  /// Of the walls' offsets, as far as earlier scans have shown.
  double max_map_sigma_m = BeamModel::kMapSigmas_m.back();
  /// The scan was deskewed by a motion that was fitted to it, on few walls. That takes its three
  /// parameters' worth from the odds of a place, sqrt(rays) each (Schwarz 1978).
  bool fits_motion = false;
  std::optional<Prior> prior = std::nullopt;  ///< where it is fresh
};

/// Fits the pose of a scan near one place, on all rays. Allocates nothing after construction.
class PlaceFitter {
 public:
  /// `map` must outlive it.
  PlaceFitter(const WallMap& map, const LocalizerConfig& config);

  /// Starts a scan, which must outlive the calls for it.
  void begin(const PolarScan& scan, const ScanPrior& known);

  /// Of few rays, how much larger the share on walls is than that through walls: 1 at most.
  double rough_score(const Pose2& T_map_lidar);
  /// One step from a pose that is off by `search_radius_m`, by few rays; none where it leads away.
  std::optional<Pose2> roughly(const Pose2& T_map_lidar, double search_radius_m,
                               double map_sigma_m);
  BeamStatistics statistics_of_few(const Pose2& T_map_lidar);

  /// As if every wall were where the map has it. `rays` is empty where the map does not explain
  /// them. `first`: rays of the first steps.
  VerifiedHypothesis exactly(const Pose2& T_map_lidar, double search_radius_m,
                             std::span<const PolarPoint> first);
  VerifiedHypothesis exactly(const Pose2& T_map_lidar, double search_radius_m) {
    return exactly(T_map_lidar, search_radius_m, few_);
  }
  /// With the walls' offsets marginalised, unless they show themselves to be none. `map_sigma_m`:
  /// of the offsets, by few rays. `exact`: the same place as exactly() gave it.
  VerifiedHypothesis with_offsets(const Pose2& T_map_lidar, double search_radius_m,
                                  double map_sigma_m, const RefinedPose& exact);
  /// The rays that reach walls hit them, and walls that are off would show.
  bool is_exact(const VerifiedHypothesis& fit) const;
  /// The scan, or a prior, holds the pose in each direction: no single wall, no bare corridor.
  bool is_determined(const RefinedPose& refined) const;
  /// Of all rays at a place. Free where it is that of the last exactly().
  BeamStatistics statistics(const VerifiedHypothesis& place);

 private:
  void meet(const Pose2& T_map_lidar);
  bool may_be_off() const { return known_.max_map_sigma_m > BeamModel::kMapSigmas_m.front(); }

  const WallMap& map_;
  RayCaster ray_caster_;
  Refinement refinement_;
  BeamModel beam_model_;
  std::span<const PolarPoint> points_;
  double spacing_rad_ = 0;
  std::vector<PolarPoint> few_;
  ScanPrior known_;
  std::optional<Pose2> T_map_met_;  ///< where the beam model's rays are, all of them
};

}  // namespace cornerd::core
