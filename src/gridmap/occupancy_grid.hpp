// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "gridmap/image.hpp"
#include "gridmap/map_server_yaml.hpp"

namespace cornerd::gridmap {

enum class Cell : std::uint8_t { kFree, kOccupied, kUnknown };

/// Square cells, with column 0 and row 0 at the lower left. Points have coordinates in cells: cell
/// (column, row) reaches from there to (column + 1, row + 1).
class OccupancyGrid {
 public:
  /// All unknown.
  OccupancyGrid(std::size_t columns, std::size_t rows)
      : columns_(static_cast<std::int64_t>(columns)),
        rows_(static_cast<std::int64_t>(rows)),
        cells_(columns * rows, Cell::kUnknown) {}

  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }
  std::size_t count(Cell kind) const;

  bool holds(std::int64_t column, std::int64_t row) const {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  }
  /// Unknown outside of the picture.
  Cell at(std::int64_t column, std::int64_t row) const {
    return holds(column, row) ? cells_[index(column, row)] : Cell::kUnknown;
  }
  Cell at(const core::Vec2& point) const;
  void set(std::int64_t column, std::int64_t row, Cell kind) { cells_[index(column, row)] = kind; }

 private:
  std::size_t index(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }

  std::int64_t columns_;
  std::int64_t rows_;
  std::vector<Cell> cells_;
};

/// Occupancy of the pixels as in map_server. Between the thresholds: unknown in the mode trinary,
/// the nearer state in scale, and in a trinary picture that has many shades there. In raw, values
/// are per cent, and unknown above 100. Transparent pixels are unknown.
OccupancyGrid read_shades(const Image& image, const MapServerYaml& yaml);

}  // namespace cornerd::gridmap
