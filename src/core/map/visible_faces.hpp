// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/map/occlusion_buffer.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Finds the faces visible from a point: visits the map's cells from near to far, in the sectors
/// that the faces found so far leave open. The cost depends on what is visible, not on the size of
/// the map. Allocates nothing.
class VisibleFaces {
 public:
  /// Calls visit(index into map.faces(), VisibleFace) for every face that may be visible from
  /// `origin` within `max_range_m`. Complete, with few false positives.
  template <typename Visitor>
  void find(const WallMap& map, const Vec2& origin, double max_range_m, Visitor&& visit);

  /// After find(): upper bounds of the visible range.
  const OcclusionBuffer& occlusion() const { return occlusion_; }

 private:
  /// A long face lies in many cells; this many visits are recorded so that few faces are visited
  /// twice.
  static constexpr std::size_t kMaxVisits = 512;
  struct Visit {
    std::uint32_t face = 0;
    std::uint32_t find = 0;
  };
  bool is_new(std::uint32_t face) {
    Visit& visit_record = visits_[face % kMaxVisits];
    if (visit_record.face == face && visit_record.find == search_) return false;
    visit_record = {face, search_};
    return true;
  }
  template <typename Visitor>
  void find_in_cell(const WallMap& map, const Vec2& origin, std::size_t column, std::size_t row,
                    OcclusionBuffer::Sectors open, Visitor&& visit);
  void begin(double max_range_m);

  OcclusionBuffer occlusion_;
  std::array<Visit, kMaxVisits> visits_{};
  std::uint32_t search_ = 0;
};

inline void VisibleFaces::begin(double max_range_m) {
  occlusion_.reset(max_range_m);
  if (++search_ == 0) {
    visits_.fill({});
    search_ = 1;
  }
}

template <typename Visitor>
void VisibleFaces::find_in_cell(const WallMap& map, const Vec2& origin, std::size_t column,
                                std::size_t row, OcclusionBuffer::Sectors open, Visitor&& visit) {
  const CellGrid& grid = map.face_grid();
  const auto faces = grid.in_cell(column, row);
  if (faces.empty()) return;
  const double half_m = grid.cell_m() / 2;
  const Vec2 middle = grid.lower_left() + Vec2(static_cast<double>(2 * column + 1) * half_m,
                                               static_cast<double>(2 * row + 1) * half_m);
  if ((OcclusionBuffer::sectors_of(middle - origin, half_m) & open) == 0) return;
  for (const std::uint32_t index : faces) {
    const Face& face = map.faces()[index];
    VisibleFace visible;
    visible.height_m = face.normal.dot(origin) - face.offset_m;
    if (visible.height_m <= 0 || !is_new(index)) continue;
    visible.from = face.from - origin;
    visible.to = face.to - origin;
    if (occlusion_.add(face, visible)) visit(index, visible);
  }
}

template <typename Visitor>
void VisibleFaces::find(const WallMap& map, const Vec2& origin, double max_range_m,
                        Visitor&& visit) {
  begin(max_range_m);
  const CellGrid& grid = map.face_grid();
  const Vec2 position = (origin - grid.lower_left()) / grid.cell_m();
  const auto columns = static_cast<std::ptrdiff_t>(grid.columns());
  const auto rows = static_cast<std::ptrdiff_t>(grid.rows());
  const double max_range = max_range_m / grid.cell_m() + 1;
  // Out of range of the whole map, or not finite.
  if (!(position.x() > -max_range && position.y() > -max_range &&
        position.x() < static_cast<double>(columns) + max_range &&
        position.y() < static_cast<double>(rows) + max_range)) {
    return;
  }
  const auto column = static_cast<std::ptrdiff_t>(std::floor(position.x()));
  const auto row = static_cast<std::ptrdiff_t>(std::floor(position.y()));
  const double to_column = position.x() - static_cast<double>(column);
  const double to_row = position.y() - static_cast<double>(row);
  const double to_border =
      std::min(std::min(to_column, 1 - to_column), std::min(to_row, 1 - to_row));
  const std::ptrdiff_t rings =
      std::max(std::max(column, columns - 1 - column), std::max(row, rows - 1 - row));
  OcclusionBuffer::Sectors open = 0;
  const auto visit_cell = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
    find_in_cell(map, origin, static_cast<std::size_t>(c), static_cast<std::size_t>(r), open,
                 visit);
  };
  // Rings of cells around the viewpoint's own, until no cell is nearer than the visible range.
  for (std::ptrdiff_t ring = 0; ring <= rings; ++ring) {
    const double near_m = (static_cast<double>(ring - 1) + to_border) * grid.cell_m();
    open = occlusion_.open_sectors(near_m);
    if (open == 0) return;
    const std::ptrdiff_t first_row = std::max<std::ptrdiff_t>(row - ring, 0);
    const std::ptrdiff_t last_row = std::min(row + ring, rows - 1);
    const std::ptrdiff_t first_column = std::max<std::ptrdiff_t>(column - ring, 0);
    const std::ptrdiff_t last_column = std::min(column + ring, columns - 1);
    for (std::ptrdiff_t r = first_row; r <= last_row; ++r) {
      if (r == row - ring || r == row + ring) {
        for (std::ptrdiff_t c = first_column; c <= last_column; ++c) visit_cell(c, r);
      } else {
        if (column - ring >= 0 && column - ring < columns) visit_cell(column - ring, r);
        if (column + ring >= 0 && column + ring < columns && ring > 0) visit_cell(column + ring, r);
      }
    }
  }
}

}  // namespace cornerd::core
