// SPDX-License-Identifier: MIT
// El Amin et al., section IV.B.4: the three stages as they are published, to measure against.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/catalog/catalog.hpp"
#include "core/recognition/hypothesis.hpp"
#include "core/recognition/pose_table.hpp"

namespace cornerd::baseline {

/// 1. The three nearest corners are looked for in the sub-catalogues, by their types and distances.
/// 2. The remaining corners and terminals, then 3. the points that form a line, choose among what
/// is found. The pose is that of the two nearest corners. What the paper leaves open is a constant
/// in the .cpp. Takes no memory after construction; asks every landmark of the map.
class PaperRecognition {
 public:
  PaperRecognition(const core::WallMap& map, const core::Catalog& catalog);

  /// The places that stages 2 and 3 like best, several where they are level.
  std::span<const core::PoseHypothesis> places(std::span<const core::Breakpoint> breakpoints,
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
