// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Likelihood field of a map (Thrun, Burgard and Fox, Probabilistic Robotics, section 6.4) as a
/// score of 0 to 100 a cell, and its maxima over squares of 2^level cells: the bounds of branch and
/// bound (Olson 2015, "M3RSM"). Immutable.
class LikelihoodField {
 public:
  explicit LikelihoodField(const WallMap& map);

  static constexpr int kLevels = 7;

  struct Cell {
    std::int32_t column = 0;
    std::int32_t row = 0;
  };

  double cell_m() const { return cell_m_; }
  const Vec2& lower_left() const { return lower_left_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t memory_bytes() const { return scores_.size(); }

  /// Largest score of the cells (column, row) to (column, row) + 2^level - 1; 0 outside the field.
  int max_score(int level, int column, int row) const {
    const std::array<Cell, 1> origin{};
    return sum_of_max_scores(level, column, row, origin);
  }
  /// The sum of max_score() over points at these cells from (column, row).
  int sum_of_max_scores(int level, int column, int row, std::span<const Cell> points) const {
    const Level all = levels_[static_cast<std::size_t>(level)];
    const std::uint8_t* const scores = scores_.data() + all.begin;
    int sum = 0;
    for (const Cell& point : points) {
      // Huge where it is negative.
      const auto x = static_cast<std::uint32_t>(column + point.column + all.last);
      const auto y = static_cast<std::uint32_t>(row + point.row + all.last);
      if (x < all.columns && y < all.rows) sum += scores[y * all.columns + x];
    }
    return sum;
  }

 private:
  /// Squares that overlap the field: their first cells are from -last.
  struct Level {
    std::size_t begin = 0;  ///< in scores_
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    int last = 0;  ///< 2^level - 1
  };
  std::uint8_t& at(int level, int column, int row) {
    const Level& all = levels_[static_cast<std::size_t>(level)];
    return scores_[all.begin + static_cast<std::uint32_t>(row + all.last) * all.columns +
                   static_cast<std::uint32_t>(column + all.last)];
  }
  void draw(const Face& face);
  void pool(int level);

  double cell_m_ = 0;
  Vec2 lower_left_ = Vec2::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::array<Level, kLevels> levels_;
  std::vector<std::uint8_t> scores_;
};

}  // namespace cornerd::core
