// SPDX-License-Identifier: MIT
// The star catalogue of a building: its corners, and the distances between those that see each
// other (El Amin et al., section IV.B.4b: main catalogue and sub-catalogues).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Two landmarks in line of sight, as indices into Catalog::landmarks().
struct LandmarkPair {
  double distance_m = 0;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// Made once from the map. Immutable; const methods may be called from any thread.
class Catalog {
 public:
  /// `reach_m`: pairs farther apart than this are not kept.
  Catalog(const WallMap& map, double reach_m);

  std::span<const Corner> landmarks() const { return landmarks_; }

  /// All pairs whose distance lies in [low_m, high_m], by rising distance. The sorted distances are
  /// addressed directly (the k-vector of star trackers): no search, however large the catalogue.
  std::span<const LandmarkPair> pairs_between(double low_m, double high_m) const;
  std::size_t pair_count() const { return pairs_.size(); }

  /// Calls visit(index) for every landmark that may lie within kVisitRadius_m of the point.
  template <typename Visitor>
  void visit_near(const Vec2& point, Visitor&& visit) const {
    const std::size_t first_column = column_of(point.x() - kVisitRadius_m);
    const std::size_t last_column = column_of(point.x() + kVisitRadius_m);
    const std::size_t last_row = row_of(point.y() + kVisitRadius_m);
    for (std::size_t row = row_of(point.y() - kVisitRadius_m); row <= last_row; ++row) {
      for (std::size_t column = first_column; column <= last_column; ++column) {
        const std::size_t cell = row * columns_ + column;
        for (std::uint32_t i = first_in_cell_[cell]; i < first_in_cell_[cell + 1]; ++i) {
          visit(in_cells_[i]);
        }
      }
    }
  }

  static constexpr double kVisitRadius_m = 0.1;

 private:
  /// Cells outside the map are those at its border.
  std::size_t column_of(double x_m) const { return cell_of(x_m - lower_left_.x(), columns_); }
  std::size_t row_of(double y_m) const { return cell_of(y_m - lower_left_.y(), rows_); }
  std::size_t cell_of(double distance_m, std::size_t count) const {
    if (!(distance_m > 0)) return 0;
    const double cell = distance_m / cell_m_;
    return cell < static_cast<double>(count - 1) ? static_cast<std::size_t>(cell) : count - 1;
  }
  void index_places(const WallMap& map);
  void collect_pairs(const WallMap& map, double reach_m);
  void index_pairs();

  std::vector<Corner> landmarks_;
  std::vector<LandmarkPair> pairs_;        ///< by rising distance
  std::vector<std::uint32_t> first_pair_;  ///< for each bin of distance: the first pair in it

  // A grid over the map: the landmarks of cell i are in_cells_[first_in_cell_[i]] and following.
  Vec2 lower_left_ = Vec2::Zero();
  double cell_m_ = 0;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::uint32_t> first_in_cell_;
  std::vector<std::uint32_t> in_cells_;
};

}  // namespace cornerd::core
