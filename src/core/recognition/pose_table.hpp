// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/recognition/hypothesis.hpp"

namespace cornerd::core {

/// Gathers the places that a turn's patterns point to and counts how often each is named. Places
/// are told apart by cells of a few centimetres and degrees, so that one that lies at their border
/// is there more than once. All memory is taken at construction.
class PoseTable {
 public:
  /// What is more than `capacity` is dropped.
  explicit PoseTable(std::size_t capacity);

  void clear();
  void add(const Pose2& T_map_lidar);

  /// The places that were named most, at most `count`, in no particular order; `votes` says how
  /// often. May be changed in place; valid until the next call.
  std::span<Hypothesis> most_named(std::size_t count);

 private:
  std::size_t capacity_;
  std::vector<Hypothesis> places_;
  std::vector<std::uint64_t> keys_;   ///< the cell of each of the places
  std::vector<std::uint16_t> slots_;  ///< hashed by cell: a place's number and one, or 0
};

}  // namespace cornerd::core
