// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

  double cell_m() const { return cell_m_; }
  const Vec2& lower_left() const { return lower_left_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  std::size_t memory_bytes() const { return scores_.size(); }

  /// Largest score of the cells (column, row) to (column, row) + 2^level - 1; 0 outside the field.
  int max_score(int level, int column, int row) const {
    const int last = (1 << level) - 1;
    if (column + last < 0 || row + last < 0 || column >= columns_ || row >= rows_) return 0;
    return scores_[index(level, std::max(column, 0), std::max(row, 0))];
  }

 private:
  std::size_t index(int level, int column, int row) const {
    return (static_cast<std::size_t>(level) * static_cast<std::size_t>(rows_) +
            static_cast<std::size_t>(row)) *
               static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  void draw(const Face& face);
  void pool(int level);

  double cell_m_ = 0;
  Vec2 lower_left_ = Vec2::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint8_t> scores_;
};

}  // namespace cornerd::core
