// SPDX-License-Identifier: MIT
// The star catalogue of a building: its corners and the distances between those in line of sight
// (El Amin et al., section IV.B.4b: main catalogue and sub-catalogues).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/catalog/pair_index.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Built once from the map. Immutable; const methods are safe from any thread.
class Catalog {
 public:
  /// Pairs farther apart than `max_distance_m` are left out.
  Catalog(const WallMap& map, double max_distance_m);

  /// The map's corners; of more than kMaxCrowded within a decimetre the first.
  std::span<const Corner> landmarks() const { return landmarks_; }

  /// The pairs of landmarks in line of sight. A landmark with very many visible others keeps the
  /// nearest: kMaxNeighbours, fewer where the map has more than kMaxPairs / kMaxNeighbours
  /// landmarks.
  const PairIndex& pairs() const { return pairs_; }
  /// The sub-catalogue of one landmark: its pairs, nearest first.
  std::span<const LandmarkPair> neighbours(std::uint32_t landmark) const {
    return std::span(neighbours_)
        .subspan(first_neighbour_[landmark],
                 first_neighbour_[landmark + 1] - first_neighbour_[landmark]);
  }

  /// Calls visit(index) for every landmark that may lie within kVisitRadius_m of the point.
  template <typename Visitor>
  void visit_near(const Vec2& point, Visitor&& visit) const {
    visit_within(point, kVisitRadius_m, visit);
  }

  std::size_t memory_bytes() const;

  static constexpr double kVisitRadius_m = 0.1;
  static constexpr std::size_t kMaxNeighbours = 32;
  /// Two walls that cross have 4 corners there.
  static constexpr std::size_t kMaxCrowded = 16;
  static constexpr std::size_t kMaxPairs = 800'000;

 private:
  /// Points outside the map fall into the cells at its border.
  std::size_t column_of(double x_m) const { return cell_of(x_m - lower_left_.x(), columns_); }
  std::size_t row_of(double y_m) const { return cell_of(y_m - lower_left_.y(), rows_); }
  std::size_t cell_of(double distance_m, std::size_t count) const {
    if (!(distance_m > 0)) return 0;
    const double cell = distance_m / cell_m_;
    return cell < static_cast<double>(count - 1) ? static_cast<std::size_t>(cell) : count - 1;
  }
  template <typename Visitor>
  void visit_within(const Vec2& point, double radius_m, Visitor&& visit) const {
    const std::size_t first_column = column_of(point.x() - radius_m);
    const std::size_t last_column = column_of(point.x() + radius_m);
    const std::size_t last_row = row_of(point.y() + radius_m);
    for (std::size_t row = row_of(point.y() - radius_m); row <= last_row; ++row) {
      const std::uint32_t begin = first_in_cell_[row * columns_ + first_column];
      const std::uint32_t end = first_in_cell_[row * columns_ + last_column + 1];
      for (std::uint32_t i = begin; i < end; ++i) visit(in_cells_[i]);
    }
  }
  void index_landmarks(const WallMap& map);
  std::vector<LandmarkPair> visible_pairs(const WallMap& map, double max_distance_m) const;
  void list_neighbours(std::span<const LandmarkPair> pairs);

  std::vector<Corner> landmarks_;
  PairIndex pairs_;
  std::vector<LandmarkPair> neighbours_;
  std::vector<std::uint32_t> first_neighbour_;

  // A grid over the map. The landmarks of cell i start at in_cells_[first_in_cell_[i]].
  Vec2 lower_left_ = Vec2::Zero();
  double cell_m_ = 0;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::uint32_t> first_in_cell_;
  std::vector<std::uint32_t> in_cells_;
};

}  // namespace cornerd::core
