// SPDX-License-Identifier: MIT
#include "gridmap/cleaning.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace cornerd::gridmap {
namespace {

Patch describe(const std::vector<CellIndex>& places) {
  Patch patch;
  patch.cells = places.size();
  CellIndex low = places.front();
  CellIndex high = low;
  for (const CellIndex& place : places) {
    low = {std::min(low.column, place.column), std::min(low.row, place.row)};
    high = {std::max(high.column, place.column), std::max(high.row, place.row)};
  }
  patch.size = static_cast<double>(std::max(high.column - low.column, high.row - low.row) + 1);
  patch.centre = {static_cast<double>(low.column + high.column + 1) / 2,
                  static_cast<double>(low.row + high.row + 1) / 2};
  return patch;
}

/// Called after all patches are found, since a removal may split or join others.
void forget(OccupancyGrid& grid, const std::vector<CellIndex>& places) {
  for (const CellIndex& place : places) grid.set(place.column, place.row, Cell::kUnknown);
}

}  // namespace

std::vector<Patch> drop_specks(OccupancyGrid& grid, double size) {
  std::vector<Patch> dropped;
  std::vector<CellIndex> going;
  for_each_patch(grid, Cell::kOccupied, 8, [&](const std::vector<CellIndex>& places) {
    const Patch patch = describe(places);
    if (patch.size >= size) return;
    dropped.push_back(patch);
    going.insert(going.end(), places.begin(), places.end());
  });
  forget(grid, going);
  return dropped;
}

std::vector<Patch> drop_pockets(OccupancyGrid& grid, std::size_t cells) {
  std::size_t largest = 0;
  for_each_patch(grid, Cell::kFree, 4, [&](const std::vector<CellIndex>& places) {
    largest = std::max(largest, places.size());
  });
  std::vector<Patch> dropped;
  std::vector<CellIndex> going;
  for_each_patch(grid, Cell::kFree, 4, [&](const std::vector<CellIndex>& places) {
    if (places.size() >= std::min(cells, largest)) return;
    dropped.push_back(describe(places));
    going.insert(going.end(), places.begin(), places.end());
  });
  forget(grid, going);
  return dropped;
}

OccupancyGrid coarser(const OccupancyGrid& grid, std::int64_t factor) {
  const auto count = [&](std::int64_t cells) {
    return static_cast<std::size_t>((cells + factor - 1) / factor);
  };
  OccupancyGrid coarse(count(grid.columns()), count(grid.rows()));
  for (std::int64_t row = 0; row < grid.rows(); ++row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      const Cell cell = grid.at(column, row);
      const Cell other = coarse.at(column / factor, row / factor);
      if (cell == Cell::kOccupied || (cell == Cell::kFree && other == Cell::kUnknown)) {
        coarse.set(column / factor, row / factor, cell);
      }
    }
  }
  return coarse;
}

double buried_share(const OccupancyGrid& grid) {
  std::size_t occupied = 0;
  std::size_t buried = 0;
  for (std::int64_t row = 0; row < grid.rows(); ++row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      if (grid.at(column, row) != Cell::kOccupied) continue;
      ++occupied;
      buried +=
          std::all_of(kNeighbours.begin(), kNeighbours.end(),
                      [&](const CellIndex& step) {
                        return grid.at(column + step.column, row + step.row) == Cell::kOccupied;
                      })
              ? 1
              : 0;
    }
  }
  return occupied == 0 ? 0 : static_cast<double>(buried) / static_cast<double>(occupied);
}

}  // namespace cornerd::gridmap
