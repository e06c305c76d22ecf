// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Two landmarks in line of sight, as indices into Catalog::landmarks().
struct LandmarkPair {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  float distance_m = 0;
};

/// Which of a corner's two walls, seen from its opening.
enum class FaceSide : std::uint8_t { kLeft, kRight };

/// A pair of breakpoints, as a query for pairs of landmarks.
struct PairQuery {
  double low_m = 0;  ///< lower and upper bound of the distance
  double high_m = 0;
  bool convex = false;  ///< kind of the first landmark
  FaceSide side = FaceSide::kLeft;
  double wall_rad =
      0;  ///< direction of that wall of the first, relative to the direction to the second
  double tolerance_rad = 0;
};

/// All pairs in both directions, indexed by distance, kind of the first corner and direction of one
/// of its walls relative to the pair's direction. The index is an address (the k-vector of star
/// trackers, in three dimensions), so that a look-up needs no search.
class PairIndex {
 public:
  PairIndex() = default;
  /// `pairs`: each pair once.
  PairIndex(std::span<const Corner> landmarks, std::span<const LandmarkPair> pairs);

  /// Number of pairs.
  std::size_t size() const { return entries_.size() / 4; }

  /// Calls visit(LandmarkPair) for all pairs that match the query. Wall directions match within the
  /// tolerance plus one bin (2 pi / kDirections).
  template <typename Visitor>
  void visit(const PairQuery& query, Visitor&& visit) const {
    for_each_run(query, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const LandmarkPair& pair = entries_[i];
        if (pair.distance_m >= query.low_m && pair.distance_m <= query.high_m) visit(pair);
      }
    });
  }

  /// Number of entries that visit() reads.
  std::size_t cost(const PairQuery& query) const {
    std::size_t sum = 0;
    for_each_run(query, [&](std::size_t begin, std::size_t end) { sum += end - begin; });
    return sum;
  }

  std::size_t memory_bytes() const {
    return entries_.capacity() * sizeof(LandmarkPair) + first_.capacity() * sizeof(std::uint32_t);
  }

  static constexpr std::size_t kDirections = 36;

 private:
  static constexpr double kBin_m = 0.02;
  static constexpr double kDirection_rad = kTwoPi / kDirections;

  /// Index in first_ of the first distance bin of a kind and a direction.
  std::size_t row(FaceSide side, bool convex, std::size_t direction) const {
    const std::size_t kind = (side == FaceSide::kRight ? 2 : 0) + (convex ? 1 : 0);
    return (kind * kDirections + direction) * bins_;
  }
  std::size_t bin_of(double distance_m) const {
    return std::min(static_cast<std::size_t>(std::max(0.0, distance_m) / kBin_m), bins_ - 1);
  }
  std::size_t address(const Corner& from, const Corner& to, double distance_m, FaceSide side) const;

  template <typename Visitor>
  void for_each_run(const PairQuery& query, Visitor&& visit) const {
    if (entries_.empty() || query.low_m >= kBin_m * static_cast<double>(bins_)) return;
    const std::size_t low = bin_of(query.low_m);
    const std::size_t high = bin_of(query.high_m);
    const double first = std::floor((query.wall_rad - query.tolerance_rad) / kDirection_rad);
    const double last = std::floor((query.wall_rad + query.tolerance_rad) / kDirection_rad);
    const auto count = std::min(static_cast<std::size_t>(last - first) + 1, kDirections);
    auto direction = static_cast<std::size_t>(first + 2 * kDirections) % kDirections;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t start = row(query.side, query.convex, direction);
      visit(first_[start + low], first_[start + high + 1]);
      direction = (direction + 1) % kDirections;
    }
  }

  std::size_t bins_ = 1;
  std::vector<LandmarkPair> entries_;
  std::vector<std::uint32_t> first_;  ///< for each address: its first entry
};

}  // namespace cornerd::core
