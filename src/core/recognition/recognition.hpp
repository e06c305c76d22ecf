// SPDX-License-Identifier: MIT
// Global recognition: from a scan's breakpoints to pose hypotheses, as a star tracker matches
// stars.
#pragma once

#include <span>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/catalog/catalog.hpp"
#include "core/recognition/hypothesis.hpp"
#include "core/recognition/pose_table.hpp"

namespace cornerd::core {

/// Matches pairs of breakpoints with pairs of the catalogue by distance and wall directions; all
/// breakpoints then vote on each hypothesis. The work per scan is bounded whatever the map's size:
/// rare pairs are looked up first. Allocates nothing after construction.
class Recognition {
 public:
  explicit Recognition(const Catalog& catalog);

  /// Hypotheses of pairs of breakpoints, most votes first, without duplicates.
  std::span<const PoseHypothesis> from_pairs(std::span<const Breakpoint> breakpoints);

  /// Number of breakpoints with a landmark under this hypothesis.
  int recognised(std::span<const Breakpoint> breakpoints, const Pose2& T_map_lidar) const;

  static constexpr std::size_t kMaxHypotheses = 2048;

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
  void add(const Pose2& T_map_lidar);
  int votes(const Pose2& T_map_lidar) const;
  bool has_landmark(const Breakpoint& breakpoint, const Pose2& T_map_lidar, double c,
                    double s) const;
  std::span<const PoseHypothesis> ranked();

  const Catalog& catalog_;
  std::vector<const Breakpoint*> selected_;
  std::vector<SelectedPair> pairs_;
  PoseTable hypotheses_;
};

/// True where a breakpoint seen at the given heading matches the landmark: the same kind of corner
/// and the same wall directions.
bool matches(const Breakpoint& breakpoint, const Corner& landmark, double heading_rad);

}  // namespace cornerd::core
