// SPDX-License-Identifier: MIT
#include "core/recognition/likelihood_field.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Cells are coarser where the field would take more memory.
constexpr double kFieldCell_m = 0.05;
constexpr std::size_t kMaxBytes = 16U << 20U;
/// Standard deviation of a range in the search, in cells: half a cell's diagonal, half a step of
/// heading at 4 m, and walls that are off by centimetres.
constexpr double kSigmaCells = 1.2;
constexpr double kBorder_m = 1;
/// Ratio of the densities on a wall and far from all walls: more, and one ray outweighs many.
constexpr double kContrast = 20;

}  // namespace

LikelihoodField::LikelihoodField(const WallMap& map) : cell_m_(kFieldCell_m) {
  const Vec2 border(kBorder_m, kBorder_m);
  lower_left_ = map.lower_left() - border;
  const Vec2 extent = map.upper_right() + border - lower_left_;
  const auto cells = [&](double length_m) { return std::floor(length_m / cell_m_) + 1; };
  constexpr int kPadding = 1 << (kLevels - 1);
  while (kLevels * (cells(extent.x()) + kPadding) * (cells(extent.y()) + kPadding) >
         static_cast<double>(kMaxBytes)) {
    cell_m_ *= 1.25;
  }
  columns_ = static_cast<int>(cells(extent.x()));
  rows_ = static_cast<int>(cells(extent.y()));
  std::size_t size = 0;
  for (int level = 0; level < kLevels; ++level) {
    const int last = (1 << level) - 1;
    levels_[static_cast<std::size_t>(level)] = {size, static_cast<std::uint32_t>(columns_ + last),
                                                static_cast<std::uint32_t>(rows_ + last), last};
    size += static_cast<std::size_t>(columns_ + last) * static_cast<std::size_t>(rows_ + last);
  }
  scores_.resize(size);
  for (const Face& face : map.faces()) draw(face);
  for (int level = 1; level < kLevels; ++level) pool(level);
}

void LikelihoodField::draw(const Face& face) {
  const double sigma_m = kSigmaCells * cell_m_;
  const double reach_m = 3 * sigma_m;
  const auto cell = [&](double length_m, int count) {
    return std::clamp(static_cast<int>(std::floor(length_m / cell_m_)), 0, count - 1);
  };
  const Vec2 low = face.from.cwiseMin(face.to) - lower_left_;
  const Vec2 high = face.from.cwiseMax(face.to) - lower_left_;
  const int first_column = cell(low.x() - reach_m, columns_);
  const int last_column = cell(high.x() + reach_m, columns_);
  for (int row = cell(low.y() - reach_m, rows_); row <= cell(high.y() + reach_m, rows_); ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const Vec2 from_start = lower_left_ + cell_m_ * Vec2(column + 0.5, row + 0.5) - face.from;
      const double along_m = std::clamp(from_start.dot(face.direction), 0.0, face.length_m);
      const double distance_m = (from_start - along_m * face.direction).norm();
      if (distance_m > reach_m) continue;
      const double density = std::exp(-distance_m * distance_m / (2 * sigma_m * sigma_m));
      const auto score =
          static_cast<std::uint8_t>(100 * std::log1p(kContrast * density) / std::log1p(kContrast));
      at(0, column, row) = std::max(at(0, column, row), score);
    }
  }
}

void LikelihoodField::pool(int level) {
  const int half = 1 << (level - 1);
  const int last = 2 * half - 1;
  for (int row = -last; row < rows_; ++row) {
    for (int column = -last; column < columns_; ++column) {
      const auto below = [&](int x, int y) { return max_score(level - 1, column + x, row + y); };
      at(level, column, row) = static_cast<std::uint8_t>(
          std::max({below(0, 0), below(half, 0), below(0, half), below(half, half)}));
    }
  }
}

}  // namespace cornerd::core
