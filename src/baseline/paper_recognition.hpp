// SPDX-License-Identifier: MIT
// Corner recognition as published by El Amin et al., section IV.B.4.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/catalog/catalog.hpp"
#include "core/recognition/hypothesis.hpp"
#include "core/recognition/pose_table.hpp"

namespace cornerd::baseline {

/// Stage 1 searches the sub-catalogues for the three nearest corners, by type and distance. Stage 2
/// counts the remaining corners and terminals, stage 3 the lines on walls. The pose follows from
/// the two nearest corners. Parameters that the paper leaves open are constants in the .cpp.
/// Allocates nothing after construction; visits every landmark of the map.
class PaperRecognition {
 public:
  PaperRecognition(const core::WallMap& map, const core::Catalog& catalog);

  /// The best pose hypotheses of stages 2 and 3; several in a tie.
  std::span<const core::PoseHypothesis> hypotheses(std::span<const core::Breakpoint> breakpoints,
                                                   std::span<const core::WallSegment> segments);

 private:
  using Triple = std::array<const core::Breakpoint*, 3>;
  bool find_nearest(std::span<const core::Breakpoint> breakpoints);
  void match_nearest();
  void propose(const core::Corner& a, const core::Corner& b, const core::Corner& c);
  int recognised(std::span<const core::Breakpoint> breakpoints,
                 const core::Pose2& T_map_lidar) const;
  int lines_on_walls(std::span<const core::WallSegment> segments,
                     const core::Pose2& T_map_lidar) const;

  const core::WallMap& map_;
  const core::Catalog& catalog_;
  Triple nearest_{};
  core::PoseTable found_;
};

}  // namespace cornerd::baseline
