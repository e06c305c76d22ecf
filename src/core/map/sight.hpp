// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/map/horizon.hpp"
#include "core/map/wall_map.hpp"

namespace cornerd::core {

/// Finds the faces that a place can see without asking those that it cannot: goes through the map's
/// cells from near to far, past what the faces met so far leave open. What that costs depends on
/// what is seen, not on the size of the map. Takes no memory after construction.
class Sight {
 public:
  /// Calls visit(index into map.faces(), FaceInSight) for every face of which some may be seen from
  /// `origin` within `reach_m`: for all that are seen, and for few that are not.
  template <typename Visitor>
  void look(const WallMap& map, const Vec2& origin, double reach_m, Visitor&& visit);

  /// After look(): how far it is at most that one sees.
  const Horizon& horizon() const { return horizon_; }

 private:
  /// A long face lies in many cells; this many are remembered so that few are visited twice.
  static constexpr std::size_t kRemembered = 512;
  struct Memory {
    std::uint32_t face = 0;
    std::uint32_t look = 0;
  };
  bool is_new(std::uint32_t face) {
    Memory& memory = memory_[face % kRemembered];
    if (memory.face == face && memory.look == look_) return false;
    memory = {face, look_};
    return true;
  }
  template <typename Visitor>
  void look_into(const WallMap& map, const Vec2& origin, std::size_t column, std::size_t row,
                 Horizon::Sectors open, Visitor&& visit);
  void begin(double reach_m);

  Horizon horizon_;
  std::array<Memory, kRemembered> memory_{};
  std::uint32_t look_ = 0;
};

inline void Sight::begin(double reach_m) {
  horizon_.reset(reach_m);
  if (++look_ == 0) {
    memory_.fill({});
    look_ = 1;
  }
}

template <typename Visitor>
void Sight::look_into(const WallMap& map, const Vec2& origin, std::size_t column, std::size_t row,
                      Horizon::Sectors open, Visitor&& visit) {
  const CellGrid& grid = map.face_grid();
  const auto faces = grid.in_cell(column, row);
  if (faces.empty()) return;
  const double half_m = grid.cell_m() / 2;
  const Vec2 middle = grid.lower_left() + Vec2(static_cast<double>(2 * column + 1) * half_m,
                                               static_cast<double>(2 * row + 1) * half_m);
  if ((Horizon::around(middle - origin, half_m) & open) == 0) return;
  for (const std::uint32_t index : faces) {
    const Face& face = map.faces()[index];
    FaceInSight seen;
    seen.height_m = face.normal.dot(origin) - face.offset_m;
    if (seen.height_m <= 0 || !is_new(index)) continue;
    seen.from = face.from - origin;
    seen.to = face.to - origin;
    if (horizon_.add(face, seen)) visit(index, seen);
  }
}

template <typename Visitor>
void Sight::look(const WallMap& map, const Vec2& origin, double reach_m, Visitor&& visit) {
  begin(reach_m);
  const CellGrid& grid = map.face_grid();
  const Vec2 place = (origin - grid.lower_left()) / grid.cell_m();
  const auto columns = static_cast<std::ptrdiff_t>(grid.columns());
  const auto rows = static_cast<std::ptrdiff_t>(grid.rows());
  const double reach = reach_m / grid.cell_m() + 1;
  // So far outside that nothing is in reach; also where a number is not finite.
  if (!(place.x() > -reach && place.y() > -reach &&
        place.x() < static_cast<double>(columns) + reach &&
        place.y() < static_cast<double>(rows) + reach)) {
    return;
  }
  const auto column = static_cast<std::ptrdiff_t>(std::floor(place.x()));
  const auto row = static_cast<std::ptrdiff_t>(std::floor(place.y()));
  const double to_column = place.x() - static_cast<double>(column);
  const double to_row = place.y() - static_cast<double>(row);
  const double to_border =
      std::min(std::min(to_column, 1 - to_column), std::min(to_row, 1 - to_row));
  const std::ptrdiff_t rings =
      std::max(std::max(column, columns - 1 - column), std::max(row, rows - 1 - row));
  Horizon::Sectors open = 0;
  const auto look_at = [&](std::ptrdiff_t c, std::ptrdiff_t r) {
    look_into(map, origin, static_cast<std::size_t>(c), static_cast<std::size_t>(r), open, visit);
  };
  // Rings of cells around the place's own, until none has a cell nearer than what is seen.
  for (std::ptrdiff_t ring = 0; ring <= rings; ++ring) {
    const double near_m = (static_cast<double>(ring - 1) + to_border) * grid.cell_m();
    open = horizon_.open_beyond(near_m);
    if (open == 0) return;
    const std::ptrdiff_t first_row = std::max<std::ptrdiff_t>(row - ring, 0);
    const std::ptrdiff_t last_row = std::min(row + ring, rows - 1);
    const std::ptrdiff_t first_column = std::max<std::ptrdiff_t>(column - ring, 0);
    const std::ptrdiff_t last_column = std::min(column + ring, columns - 1);
    for (std::ptrdiff_t r = first_row; r <= last_row; ++r) {
      if (r == row - ring || r == row + ring) {
        for (std::ptrdiff_t c = first_column; c <= last_column; ++c) look_at(c, r);
      } else {
        if (column - ring >= 0 && column - ring < columns) look_at(column - ring, r);
        if (column + ring >= 0 && column + ring < columns && ring > 0) look_at(column + ring, r);
      }
    }
  }
}

}  // namespace cornerd::core
