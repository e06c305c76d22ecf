// SPDX-License-Identifier: MIT
// From a turn's breakpoints to the places where they could have been seen, as a star tracker goes
// from spots to stars.
#pragma once

#include <span>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/catalog/catalog.hpp"
#include "core/recognition/hypothesis.hpp"
#include "core/recognition/pose_table.hpp"

namespace cornerd::core {

/// Matches pairs of breakpoints with the catalogue's pairs of the same distance and the same walls,
/// then lets all breakpoints vote on each place that this gives. The work of a turn is bounded, and
/// so is the map's share in it: pairs that the building has seldom are looked up first. All memory
/// is taken at construction.
class Recognition {
 public:
  Recognition(const WallMap& map, const Catalog& catalog);

  /// The places that pairs of breakpoints point to, best voted first, each place once.
  std::span<const Hypothesis> from_pairs(std::span<const Breakpoint> breakpoints);

  /// The places that each breakpoint alone points to: a corner fixes position and heading. Far more
  /// of them, for turns that show few corners and for making sure that nothing was overlooked. In a
  /// large map only the sharpest breakpoints are asked, or none: see kMaxSingles.
  std::span<const Hypothesis> from_single_corners(std::span<const Breakpoint> breakpoints);

  /// The places that two walls point to that are not parallel: for turns that show no corner that
  /// could be trusted. The most of all, each tested only for its walls' lengths. None in a map of
  /// more than kMaxFacesForWalls faces.
  std::span<const Hypothesis> from_walls(std::span<const WallSegment> segments,
                                         std::span<const Breakpoint> breakpoints);

  /// True where no place is too far down the list to be tried: see from_walls().
  bool tries_all() const;

  /// Breakpoints that have their landmark at this place.
  int recognised(std::span<const Breakpoint> breakpoints, const Pose2& T_map_lidar) const;

  static constexpr std::size_t kMaxHypotheses = 2048;
  /// Breakpoints times landmarks that from_single_corners() compares.
  static constexpr std::size_t kMaxSingles = 8192;
  static constexpr std::size_t kMaxFacesForWalls = 360;

 private:
  struct SelectedPair {
    const Breakpoint* first = nullptr;
    const Breakpoint* second = nullptr;
    PairQuery query;
    std::size_t cost = 0;
  };
  void begin(std::span<const Breakpoint> breakpoints);
  void select_pair(const Breakpoint& one, const Breakpoint& other);
  void add_pair(const SelectedPair& pair);
  void add_walls(const WallSegment& first, const WallSegment& second);
  void add(const Pose2& T_map_lidar);
  int votes(const Pose2& T_map_lidar) const;
  bool has_landmark(const Breakpoint& breakpoint, const Pose2& T_map_lidar, double c,
                    double s) const;
  std::span<const Hypothesis> ranked();

  const WallMap& map_;
  const Catalog& catalog_;
  std::vector<const Breakpoint*> selected_;
  std::vector<SelectedPair> pairs_;
  PoseTable places_;
};

/// True where a breakpoint of a turn taken with the given heading looks like the landmark: the same
/// kind of corner, its walls in the same directions.
bool looks_like(const Breakpoint& breakpoint, const Corner& landmark, double heading_rad);

}  // namespace cornerd::core
