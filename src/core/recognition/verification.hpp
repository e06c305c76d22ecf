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

/// A place that the whole turn agrees with.
struct Place {
  RefinedPose refined;
  Explanation explanation;
};

/// Tests hypotheses against the whole turn: first roughly, on a few rays; those that pass are
/// refined on these, and those that could then be the best or its rival on all rays. All memory is
/// taken at construction.
class Verification {
 public:
  Verification(const WallMap& map, const LocalizerConfig& config);

  /// Begins a turn. `points` must outlive the calls for this turn.
  void begin(std::span<const PolarPoint> points, double noise_scale);

  /// Tests these too. `reach_m`: how far off the hypotheses may be.
  void consider(std::span<const Hypothesis> hypotheses, double reach_m);

  /// Distinct places that passed, the likeliest first.
  std::span<const Place> places() const { return places_; }

  /// How far apart places must be to count as two.
  static constexpr double kDistinct_m = 0.06;
  static constexpr double kDistinct_rad = radians(4);
  static constexpr std::size_t kMaxPlaces = 32;

 private:
  struct Candidate {
    Pose2 T_map_lidar;
    double log_likelihood = 0;
    double log_likelihood_of_things = 0;
    std::size_t explained = 0;  ///< rays, at least roughly
  };
  /// Of the turn so far: what is far behind is no rival.
  struct BestByFewRays {
    double log_likelihood = -std::numeric_limits<double>::infinity();
    double log_likelihood_of_things = -std::numeric_limits<double>::infinity();
    std::size_t explained = 0;
    std::size_t strangers = 0;  ///< rays that it does not hit
  };
  void shortlist(std::span<const Hypothesis> hypotheses, double reach_m);
  void refine_roughly(double reach_m);
  double margin_of_strangers() const;
  /// True where this leads to a place that is known and leaves no doubt.
  bool is_settled(const Pose2& T_map_lidar) const;
  void examine(const Pose2& T_map_lidar);
  bool is_known(const Pose2& T_map_lidar) const;
  bool passes(const Place& place) const;

  const WallMap& map_;
  SensorNoise noise_;
  RayCaster prediction_;
  Refinement refinement_;
  std::span<const PolarPoint> points_;
  double noise_scale_ = 1;
  std::vector<PolarPoint> thin_;
  std::vector<Candidate> candidates_;
  BestByFewRays best_;
  std::vector<Place> places_;
};

}  // namespace cornerd::core
