// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/localizer_config.hpp"
#include "core/polar_scan.hpp"
#include "core/recognition/hypothesis.hpp"
#include "core/recognition/likelihood_field.hpp"

namespace cornerd::core {

/// Search of the whole map for the poses at which most of the scan's walls lie on the map's:
/// best-first branch and bound on a likelihood field (Hess et al. 2016, algorithm 3; Olson 2015).
/// It needs no corner and misses none of the best kMaxFound poses of its headings, which are those
/// that turn most of the scan's walls into directions of the map's. Allocates nothing after
/// construction.
class MapSearch {
 public:
  explicit MapSearch(const WallMap& map);

  /// Number of poses found, at most: a narrow view of a corner fits more.
  static constexpr std::size_t kMaxFound = 64;

  /// The best distinct poses, best first; `votes` is the mean score of a point, 0 to 100.
  /// `segments`: walls of the scan.
  std::span<const PoseHypothesis> find(std::span<const PolarPoint> points,
                                       std::span<const WallSegment> segments);

  /// The same in parts: starts,
  void begin(std::span<const PolarPoint> points, std::span<const WallSegment> segments);
  /// goes on for so many nodes; true at the end,
  bool advance(std::size_t nodes);
  bool is_running() const { return !queue_.empty(); }
  void stop() { queue_.clear(); }
  /// and gives what was found so far.
  std::span<const PoseHypothesis> found() const { return found_; }

  /// False where the last search ended before its end: more nodes than kMaxNodes.
  bool is_complete() const { return complete_; }
  /// Nodes that the last search visited, each a sum over kPoints points.
  std::size_t nodes() const { return nodes_; }

  static constexpr std::size_t kMaxNodes = kWholeSearch;
  static constexpr std::size_t kPoints = 36;
  static constexpr std::size_t kHeadings = 240;

 private:
  struct Node {
    int bound = 0;              ///< sum of scores, at most
    std::uint16_t heading = 0;  ///< index into headings_
    std::uint16_t level = 0;
    int column = 0;
    int row = 0;
  };
  using HeadingWeights = std::array<double, kHeadings>;

  static bool is_worse(const Node& a, const Node& b);
  int mean_score(const Node& node) const { return node.bound / static_cast<int>(points_.size()); }
  void visit(const Node& node);
  void select_headings(std::span<const WallSegment> segments);
  void select_points(std::span<const PolarPoint> points, std::span<const WallSegment> segments);
  void rotate(std::size_t heading);
  bool push(std::uint16_t heading, int level, int column, int row);
  bool is_found(const Pose2& T_map_lidar) const;

  LikelihoodField field_;
  HeadingWeights map_directions_{};  ///< length of the faces by the direction of their normals, m
  std::vector<Vec2> points_;         ///< on the scan's walls, evenly, m
  std::vector<double> headings_;     ///< rad
  std::vector<LikelihoodField::Cell> cells_;  ///< of kPoints points, heading by heading
  std::vector<Node> queue_;                   ///< a heap
  std::vector<PoseHypothesis> found_;
  std::size_t nodes_ = 0;
  bool complete_ = true;
};

}  // namespace cornerd::core
