// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/localizer_config.hpp"
#include "core/recognition/hypothesis.hpp"
#include "core/recognition/place_evidence.hpp"
#include "core/recognition/place_fitter.hpp"
#include "core/recognition/recognition.hpp"

namespace cornerd::core {

/// The places that explain a scan best in a map that may be inexact and incomplete: hypotheses are
/// ranked by few rays and refined, with the walls' offsets marginalised where walls are not where
/// the map has them, and compared by their evidence. Allocates nothing after construction.
class PlaceSearch {
 public:
  /// `map` and `recognition` must outlive it.
  PlaceSearch(const WallMap& map, const Recognition& recognition, const LocalizerConfig& config);

  /// Starts a scan, which must outlive the calls for it.
  void begin(const PolarScan& scan, std::span<const WallSegment> segments,
             std::span<const Breakpoint> breakpoints, const ScanPrior& known);
  /// Adds hypotheses that may be off by a decimetre. `are_sure`: each is refined, however it
  /// scores.
  void consider(std::span<const PoseHypothesis> hypotheses, bool are_sure = false);
  /// The same for the pose that a prior leads to, by all rays from the first step on: of few rays
  /// none may tell the place along a corridor.
  void consider_prior(const Pose2& T_map_lidar, double search_radius_m);
  /// Compares what was considered since begin(). Distinct places, the likeliest first.
  std::span<const VerifiedHypothesis> find();
  /// False where the right place may not be among those of find(): more candidates were as good as
  /// the best than are compared.
  bool is_complete() const;
  /// The result of the last find().
  std::span<const VerifiedHypothesis> places() const { return places_; }
  /// The likeliest place if every wall were where the map has it and the rays explained by it or by
  /// a motion; none where no place explains them.
  const std::optional<VerifiedHypothesis>& exact() const { return exact_; }

  /// The scan's wall ends that the map has, at a pose.
  double wall_ends(const Pose2& T_map_lidar) const;

 private:
  struct Candidate {
    Pose2 T_map_lidar;
    double score = 0;
    double map_sigma_m = 0;
    bool is_sure = false;
  };
  static bool is_better(const Candidate& a, const Candidate& b);
  static bool is_one_place(const Pose2& T_map_one, const Pose2& T_map_other) {
    constexpr double kOnePlace_m = 0.3;
    constexpr double kOnePlace_rad = 0.15;
    return same_pose(T_map_one, T_map_other, kOnePlace_m, kOnePlace_rad);
  }
  /// The first one; null where there is none.
  const VerifiedHypothesis* exact_place() const;
  /// With its log odds by few rays.
  Candidate by_few_rays(const Pose2& T_map_lidar);
  /// False, with nothing added, where the last PlaceFitter::exactly() is not exact.
  bool add_if_exact(const VerifiedHypothesis& fit);
  /// The best candidate by few rays alone mostly is the place, and fits exactly: rough fits would
  /// tell no more of it. Others on as many rays are fitted alike: fitted roughly, even the true
  /// place loses to one that is fitted exactly.
  void fit_best_exactly();
  /// The last one that was tried, where it led here.
  VerifiedHypothesis fitted_exactly(const Pose2& T_map_lidar);
  /// One of the places that were found is there.
  bool is_compared(const Pose2& T_map_lidar) const;
  /// One of the first `kept` candidates is near.
  bool is_candidate(const Pose2& T_map_lidar, std::size_t kept, double near_m,
                    double near_rad) const;
  /// One of the places that were found is there, or one of the first `kept` candidates.
  bool is_known(const Pose2& T_map_lidar, std::size_t kept) const;
  Candidate refined_roughly(const Candidate& candidate, double least_score);
  /// By few rays, before it is refined.
  bool is_as_good_as_the_best(const Candidate& candidate) const;
  /// It is not compared, and yet may be the right one.
  void leave_out(const Candidate& candidate);
  /// Keeps of candidates that are near each other the best, kMaxRefined in all.
  void take_distinct();
  void refine_roughly();
  /// `exact`: the place as PlaceFitter::exactly() gave it.
  void add(const VerifiedHypothesis& exact, const Candidate& candidate);

  static constexpr std::size_t kMaxCandidates = 512;
  /// Candidates that are compared on all rays.
  static constexpr std::size_t kMaxCompared = 16;
  /// Remaining error of one that was refined on few rays.
  static constexpr double kFewRaysRadius_m = 0.03;
  /// Nats behind the likeliest on few rays, beyond which none was the right one.
  static constexpr double kHopeless = 16;

  const Recognition& recognition_;
  PlaceFitter fitter_;
  std::span<const PolarPoint> points_;
  std::span<const Breakpoint> breakpoints_;
  ScanPrior known_;
  ScanStructure structure_;
  std::vector<Candidate> candidates_;  ///< since the last find()
  double best_score_ = 0;              ///< of them and those before, on few rays
  double best_rough_score_ = 0;        ///< of those since begin() that are not sure
  std::vector<Pose2> left_out_;        ///< poses of candidates that were as good as the best
  std::vector<VerifiedHypothesis> places_;
  std::vector<VerifiedHypothesis> open_places_;  ///< whose pose the scan does not determine
  std::optional<VerifiedHypothesis> exact_;
  VerifiedHypothesis tried_;  ///< by fit_best_exactly()
};

}  // namespace cornerd::core
