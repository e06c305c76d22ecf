// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/estimate/constant_velocity_model.hpp"
#include "core/recognition/place_search.hpp"

namespace cornerd::core {

/// Belief that an ambiguous scan was taken elsewhere, at least. Where the likeliest place is not
/// likely enough for a fix, evidence is weak and promises too much: 3 % of such scans are elsewhere
/// (`cornerd-bench --localizer`, src/bench/poses.md, "Reliability of the posterior").
inline constexpr double kLeastDoubt = 0.03;

/// Scans so far apart show other walls, or other things before them.
inline constexpr double kIndependent_m = 1;

/// Bayes filter over the places where an inexact map may have been scanned. Each place has log odds
/// against "anywhere else, or not in this map", which every scan changes by how much likelier its
/// evidence is there than at a given wrong place. Scans from nearly one pose see the same errors of
/// the map: all those of a stretch of way count as one, by the mean of their evidence.
class PlaceFilter {
 public:
  static constexpr std::size_t kMaxPlaces = 16;
  /// Somebody carries the robot away between two scans once in 1e8 scans, five months of driving.
  static constexpr double kLogOddsAgainstCarried = 18.4;

  void forget() { count_ = 0; }
  /// A scan names `T_map_lidar` by itself, or somebody does.
  void confirm(const Pose2& T_map_lidar);
  /// A place is named by the filter: a prior is of this one from now on.
  void follow(const Pose2& T_map_lidar);
  /// `places`: of PlaceSearch, the likeliest first. `prior`: of the place that was named last.
  void update(std::span<const VerifiedHypothesis> places, const std::optional<Prior>& prior);
  /// The likeliest of the places that the last update's scan itself speaks for: an index into them.
  std::optional<std::size_t> likeliest() const { return likeliest_; }
  /// Belief that the scan was taken anywhere but at likeliest().
  double doubt() const { return doubt_; }

 private:
  struct Place {
    Pose2 T_map_lidar;    ///< in the last scan
    Pose2 T_map_begin;    ///< where the stretch began
    double base = 0;      ///< log odds by all before the stretch
    double evidence = 0;  ///< sum over its scans
    int scans = 0;
    bool is_named = false;  ///< the prior is of this one
  };
  /// Log odds of a place for which a scan at `T_map_lidar` has this evidence.
  static double weigh(Place& place, const Pose2& T_map_lidar, double evidence);

  static const VerifiedHypothesis* find(Place& place, std::span<const VerifiedHypothesis> found,
                                        const std::optional<Prior>& prior);

  std::array<Place, kMaxPlaces> places_;
  std::size_t count_ = 0;
  std::optional<std::size_t> likeliest_;
  double doubt_ = 1;
};

}  // namespace cornerd::core
