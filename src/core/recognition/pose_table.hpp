// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/recognition/hypothesis.hpp"

namespace cornerd::core {

/// Counts how often each pose is proposed. Poses are binned in cells of a few centimetres and
/// degrees; a pose near a cell's border may appear more than once. Allocates nothing after
/// construction.
class PoseTable {
 public:
  /// Poses beyond `capacity` are dropped.
  explicit PoseTable(std::size_t capacity);

  void clear();
  void add(const Pose2& T_map_lidar);

  /// The most proposed poses, at most `count`, unordered, with their counts as `votes`. May be
  /// changed in place; valid until the next call.
  std::span<PoseHypothesis> most_voted(std::size_t count);

 private:
  std::size_t capacity_;
  std::vector<PoseHypothesis> poses_;
  std::vector<std::uint64_t> keys_;   ///< cell of each pose
  std::vector<std::uint16_t> slots_;  ///< hash table: index of a pose plus one, or 0
};

}  // namespace cornerd::core
