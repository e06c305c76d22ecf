// SPDX-License-Identifier: MIT
// What Localizer keeps between scans, and the steps that it takes. Private to localizer*.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/breakpoint/detector.hpp"
#include "core/catalog/catalog.hpp"
#include "core/estimate/bias_estimator.hpp"
#include "core/estimate/constant_velocity_model.hpp"
#include "core/estimate/map_changes.hpp"
#include "core/estimate/refinement.hpp"
#include "core/estimate/scan_rotation.hpp"
#include "core/estimate/wall_offset_filter.hpp"
#include "core/localizer.hpp"
#include "core/odometry/odometer.hpp"
#include "core/recognition/decision.hpp"
#include "core/recognition/map_search.hpp"
#include "core/recognition/partial_scan_tracker.hpp"
#include "core/recognition/place_search.hpp"
#include "core/recognition/recognition.hpp"

namespace cornerd::core {

struct Localizer::Workspace {
  /// What needs a map.
  struct Place {
    Place(const WallMap& map, const LocalizerConfig& config)
        : catalog(map, config.max_range_m),
          recognition(catalog),
          map_search(map),
          place_search(map, recognition, config),
          trial(map, config),
          refinement(config.max_range_m, config.noise),
          bias(config.max_range_m, config.noise, config.bias,
               config.forget_bias ? BiasEstimator::kForgettingRate : 0) {
      if (config.learn_walls && learns_walls(map.plan())) {
        walls.emplace(map);
        changes.emplace(map, config.max_range_m);
      }
      if (config.updates_per_scan > 1) parts.emplace(map, config);
    }
    /// Where the map states how far off its walls may be.
    static bool learns_walls(const FloorPlan& plan);
    Catalog catalog;
    Recognition recognition;
    MapSearch map_search;
    PlaceSearch place_search;
    PlaceFitter trial;  ///< of single poses, as if the lidar had moved otherwise
    Refinement refinement;
    BiasEstimator bias;
    MapErrorModel map_error;
    std::optional<WallOffsetFilter> walls;
    std::optional<MapChanges> changes;        ///< where `walls` is
    std::optional<PartialScanTracker> parts;  ///< where poses are asked for before a scan ends
  };

  Workspace(std::shared_ptr<const WallMap> the_map, const LocalizerConfig& the_config)
      : config(the_config),
        T_lidar_base(the_config.T_base_lidar.inverse()),
        map(std::move(the_map)),
        detector(the_config.detector, the_config.noise),
        odometer(the_config.odometry) {
    if (map) place.emplace(*map, config);
    everywhere.reserve(MapSearch::kMaxFound);
  }

  const Scan& as_measured(const Scan& measured);
  bool knows_order() const;
  void learn_sweep(const Scan& measured, TimeNs t_ns);
  double log_odds_at(const Scan& measured, const Pose2& T_map_lidar, TimeNs t_ns);
  const Scan& deskewed(const Scan& measured, TimeNs t_ns);
  /// Scans are as they came; `prior` is what is left of odometry.
  void reject_motion(const std::optional<Prior>& prior);
  Decision find(const Scan& scan, TimeNs t_ns);
  void look(const Scan& scan, TimeNs t_ns, const ScanMotion& as_if_moving);
  VerifiedHypothesis try_at(const Scan& scan, TimeNs t_ns, const ScanMotion& as_if,
                            const Pose2& T_map_lidar, const SensorBias& bias);
  /// Covariance of a pose of the lidar from the motion that was not deskewed, m^2 and rad^2.
  /// `is_first`: no scan before tells of a motion.
  Covariance3 deskew_covariance(const Pose2& T_map_lidar, bool is_first);
  void look_for_the_motion(const Scan& scan, TimeNs t_ns);
  /// Refines the motion with the pose, where residuals are beyond the noise.
  void refine_motion(const Scan& scan, TimeNs t_ns);
  /// Neither odometry nor a scan before this one measures the rotation.
  bool rotation_is_unknown() const;
  /// Matches the scan by each of a few rotation rates. False where by none half of the rays hit.
  bool try_rotation_rates(const Scan& scan, TimeNs t_ns);
  Decision compare_places(TimeNs t_ns);
  void search_map(TimeNs t_ns);
  std::span<const PoseHypothesis> search_everywhere(TimeNs t_ns);
  bool fits_as_it_came(const Scan& scan, TimeNs t_ns);
  std::size_t corners_of(const Decision& decision) const;
  PoseState believe(const Decision& decision, std::size_t corners, TimeNs t_ns);
  const VerifiedHypothesis& chosen(const Decision& decision) const {
    return candidates[decision.place];
  }
  bool is_expected(const Pose2& T_map_lidar, TimeNs t_ns) const;
  bool prior_is_fresh(TimeNs t_ns) const;
  bool is_at_prior(const Pose2& T_map_lidar, TimeNs t_ns) const;
  /// The field of view has no gap of 170 degrees or more: the lidar is not covered.
  bool sees_all_around() const;
  /// The lidar sees around it, or a fresh prior tells where it is.
  bool sees_enough(TimeNs t_ns) const;
  /// Hardly any ray is left for a competing place.
  bool is_conclusive(const VerifiedHypothesis& found, TimeNs t_ns) const;
  bool is_conclusive(TimeNs t_ns) const;  ///< the likeliest place
  bool may_move(TimeNs t_ns) const;
  /// Of the likeliest place of an exact map; none where no place explains the scan.
  BeamCounts best_rays() const;
  /// By more than any motion would.
  bool explains_more(const BeamCounts& rays, const BeamCounts& than) const;
  /// Walls that are off look like a motion, a little: the one that was found leaves them off, and
  /// by the last scans' motion each is as straight.
  bool is_explained_by_offsets(const Scan& scan, TimeNs t_ns);
  /// Half of the rays hit at the likeliest place, and there is one.
  bool is_half_explained() const;
  bool teaches(const Decision& decision) const;
  void learn_bias(const Scan& scan, const Decision& decision, TimeNs t_ns);
  void try_bias(const Scan& scan, const Decision& decision, TimeNs t_ns);
  bool is_certain(const RefinedPose& refined) const;
  RefinedPose refine_by(WallOffsetFilter* walls, const VerifiedHypothesis& found);
  RefinedPose with_directions(const RefinedPose& parallel, const VerifiedHypothesis& found,
                              WallOffsetFilter* walls = nullptr);
  void teach_walls(const RefinedPose& refined, const VerifiedHypothesis& found);
  bool is_map_inexact() const;
  /// More than walls, to tell how the robot moves.
  bool trusts_odometry() const;
  /// What the map says, or the scan where that is more.
  double map_sigma_m(const VerifiedHypothesis& found) const;
  RefinedPose refined_by_walls(const VerifiedHypothesis& found, TimeNs t_ns);
  void report(const Decision& decision, std::size_t corners, TimeNs t_ns);
  void report_pose(const core::VerifiedHypothesis& found, std::size_t corners, TimeNs t_ns);
  void report_alternatives(std::span<const core::VerifiedHypothesis> rivals);
  std::optional<PredictedState> expectation(TimeNs t_ns);
  void predict(const PredictedPose& predicted, PoseEstimate& pose) const;
  /// What a scan showed of the noise, where it is more than chance.
  double noise_scale() const { return std::clamp(result.detection.noise_scale, 0.5, 4.0); }
  bool contradicts(const PredictedPose& predicted) const;
  bool may_set_out() const;

  LocalizerConfig config;
  Pose2 T_lidar_base;
  std::shared_ptr<const WallMap> map;
  Detector detector;
  std::optional<Place> place;

  Odometer odometer;
  Scan still;  ///< the scan as a lidar that stood still would have seen it
  /// ROS drivers turn the order of a clockwise lidar round, and the times stay: log odds that a
  /// scan's bearings were measured in the order in which they come.
  double sweep_log_odds = 0;
  Scan reversed;  ///< the scan in the opposite order
  ConstantVelocityModel memory;
  PlaceFilter filter;    ///< of the scans so far
  PlaceFilter filtered;  ///< with the one that find() looked at last
  PolarScan points;
  PolarScan tried_points;
  std::span<const PoseHypothesis> pairs;   ///< that the corners point to
  std::vector<PoseHypothesis> everywhere;  ///< by the search of the map so far
  TimeNs searched_ns = 0;
  double turned_rad = 0;  ///< since that search began
  ScanRotation rotation;
  ScanMotion motion;                                    ///< that `points` were moved back by
  bool alternatives_are_all = true;                     ///< that may be right, of the last list
  std::span<const VerifiedHypothesis> candidates;       ///< that the last decision is about
  bool saw_all_around = false;                          ///< in a scan with a pose, ever
  bool doubts_bias = false;                             ///< a stored one, not tried enough
  std::optional<BiasEstimator::Evidence> of_last_scan;  ///< of the bias, if the robot stood still
  int trials_of_bias = 0;              ///< in a row: against it, for it if negative
  std::size_t named_in_a_row = 0;      ///< scans, each near where the one before led to expect it
  std::optional<Pose2> T_map_taught;   ///< of the last scan that the walls were learned from
  std::optional<Pose2> T_map_against;  ///< of the last scan that contradicted them
  std::size_t contradictions = 0;      ///< places since then
  std::optional<Pose2> T_map_doubted;  ///< a jump of the scan before that waits for a second
  ScanResult result;
  PoseEstimate between;  ///< of a reading between two scans, or of a part of a scan
};

}  // namespace cornerd::core
