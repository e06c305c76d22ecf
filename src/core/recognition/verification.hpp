// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/estimate/refinement.hpp"
#include "core/localizer_config.hpp"
#include "core/recognition/explanation.hpp"
#include "core/recognition/hypothesis.hpp"

namespace cornerd::core {

/// A hypothesis that passed the test on all rays.
struct VerifiedHypothesis {
  RefinedPose refined;
  BeamLikelihood likelihood;
  double log_odds = 0;     ///< log_odds_of_place(), nats; of PlaceSearch alone
  double map_sigma_m = 0;  ///< of the walls' offsets, which `refined` marginalised
};

/// Tests hypotheses against the whole scan: first on a subset of rays; hypotheses that pass are
/// refined on the subset, and those that may still be the best or compete with it are tested on all
/// rays. Allocates nothing after construction.
class Verification {
 public:
  Verification(const WallMap& map, const LocalizerConfig& config);

  /// Starts a scan. `points` must outlive the calls for this scan.
  void begin(std::span<const PolarPoint> points, double noise_scale);

  /// Adds hypotheses that may be off by `search_radius_m`.
  void consider(std::span<const PoseHypothesis> hypotheses, double search_radius_m);
  /// The same for the pose that a prior leads to, by all rays from the first step on: of few rays
  /// none may tell the place along a corridor.
  void consider_prior(const Pose2& T_map_lidar, double search_radius_m);

  /// Distinct hypotheses that passed, most likely first.
  std::span<const VerifiedHypothesis> hypotheses() const { return hypotheses_; }

  /// The same whose pose the scan leaves open: a bare corridor. They are rivals to those above.
  std::span<const VerifiedHypothesis> open_hypotheses() const { return open_; }

  /// Distance between distinct hypotheses.
  static constexpr double kDistinct_m = 0.06;
  static constexpr double kDistinct_rad = radians(4);
  static constexpr std::size_t kMaxVerified = 32;

 private:
  struct Candidate {
    Pose2 T_map_lidar;
    double log_likelihood = 0;
    double log_likelihood_of_obstacles = 0;
    std::size_t on_walls = 0;  ///< rays that hit a wall or nearly
  };
  /// The best of this scan on the subset of rays, for the margins.
  struct BestByFewRays {
    double log_likelihood = -std::numeric_limits<double>::infinity();
    double log_likelihood_of_obstacles = -std::numeric_limits<double>::infinity();
    std::size_t on_walls = 0;
  };
  void shortlist(std::span<const PoseHypothesis> hypotheses, double search_radius_m);
  void refine_roughly(double search_radius_m);
  /// True where this leads to a conclusive hypothesis that is already verified.
  bool is_unambiguous(const Pose2& T_map_lidar) const;
  /// `first`: points of the first steps.
  void examine(const Pose2& T_map_lidar, double search_radius_m, std::span<const PolarPoint> first);
  void sort();
  bool is_duplicate(const Pose2& T_map_lidar) const;

  const WallMap& map_;
  SensorNoise noise_;
  RayCaster ray_caster_;
  Refinement refinement_;
  std::span<const PolarPoint> points_;
  double noise_scale_ = 1;
  std::vector<PolarPoint> subset_;
  std::vector<Candidate> candidates_;
  BestByFewRays best_;
  std::vector<VerifiedHypothesis> hypotheses_;
  std::vector<VerifiedHypothesis> open_;
};

}  // namespace cornerd::core
