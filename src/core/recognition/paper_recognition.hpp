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

namespace cornerd::core {

/// 1. The three nearest corners are looked for in the sub-catalogues, by their types and distances.
/// 2. The remaining corners and terminals, then 3. the points that form a line, choose among what
/// is found. The pose is that of the two nearest corners. What the paper leaves open is a constant
/// in the .cpp. Takes no memory after construction; asks every landmark of the map.
class PaperRecognition {
 public:
  PaperRecognition(const WallMap& map, const Catalog& catalog);

  /// The places that stages 2 and 3 like best, several where they are level.
  std::span<const PoseHypothesis> places(std::span<const Breakpoint> breakpoints,
                                         std::span<const WallSegment> segments);

 private:
  using Triple = std::array<const Breakpoint*, 3>;
  bool find_nearest(std::span<const Breakpoint> breakpoints);
  void match_nearest();
  void propose(const Corner& a, const Corner& b, const Corner& c);
  int recognised(std::span<const Breakpoint> breakpoints, const Pose2& T_map_lidar) const;
  int lines_on_walls(std::span<const WallSegment> segments, const Pose2& T_map_lidar) const;

  const WallMap& map_;
  const Catalog& catalog_;
  Triple nearest_{};
  PoseTable found_;
};

}  // namespace cornerd::core
