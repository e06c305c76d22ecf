// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/estimate/refinement.hpp"
#include "core/localizer_config.hpp"
#include "core/recognition/beam_model.hpp"
#include "core/recognition/hypothesis.hpp"
#include "core/recognition/place_evidence.hpp"
#include "core/recognition/recognition.hpp"
#include "core/recognition/verification.hpp"

namespace cornerd::core {

/// The places that explain a scan best in a map that is inexact and incomplete: hypotheses are
/// ranked by few rays, refined with the walls' offsets marginalised, and compared by the beam model
/// on faces. Allocates nothing after construction.
class PlaceSearch {
 public:
  /// `map` and `recognition` must outlive it.
  PlaceSearch(const WallMap& map, const Recognition& recognition, const LocalizerConfig& config);

  /// Starts a scan, which must outlive the calls for it.
  /// `max_map_sigma_m`: of the walls' offsets, as far as earlier scans have shown. `fits_motion`:
  /// the scan was deskewed by a motion that was fitted to it, on few walls. That takes its three
  /// parameters' worth from the odds of a place, sqrt(rays) each (Schwarz 1978).
  void begin(const PolarScan& scan, std::span<const WallSegment> segments,
             std::span<const Breakpoint> breakpoints, double noise_scale, double max_map_sigma_m,
             bool fits_motion);
  /// Adds hypotheses that may be off by a decimetre.
  void consider(std::span<const PoseHypothesis> hypotheses);
  /// Compares what was considered since begin(). Distinct places, the likeliest first.
  std::span<const VerifiedHypothesis> find();
  /// The scan's wall ends that the map has, at a pose.
  double wall_ends(const Pose2& T_map_lidar) const;
  /// The result of the last find().
  std::span<const VerifiedHypothesis> places() const { return places_; }

 private:
  struct Candidate {
    Pose2 T_map_lidar;
    double score = 0;
    double map_sigma_m = 0;
  };
  double rough_score(const Pose2& T_map_lidar);
  Candidate refined_roughly(const Candidate& candidate, double spacing_rad, double least_score);
  void refine_roughly();
  void add(const Candidate& candidate);

  static constexpr std::size_t kMaxCandidates = 512;

  const WallMap& map_;
  const Recognition& recognition_;
  RayCaster ray_caster_;
  Refinement refinement_;
  BeamModel beam_model_;
  std::span<const PolarPoint> points_;
  std::span<const Breakpoint> breakpoints_;
  double spacing_rad_ = 0;
  double noise_scale_ = 1;
  double odds_elsewhere_ = 1;  ///< of no place at all, by the motion alone
  double max_map_sigma_m_ = 0;
  ScanStructure structure_;
  std::vector<PolarPoint> subset_;
  std::vector<Candidate> candidates_;
  std::vector<VerifiedHypothesis> places_;
  std::vector<VerifiedHypothesis> open_places_;  ///< whose pose the scan does not determine
};

}  // namespace cornerd::core
