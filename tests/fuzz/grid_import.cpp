// SPDX-License-Identifier: MIT
// Any small picture gives no walls, or walls that make a map. The first byte is the width, the
// second selects options; then one byte per cell.
#include "gridmap/grid_import.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cornerd::gridmap;
  constexpr std::size_t kMaxCells = 1024;
  if (size < 3) return 0;
  const std::size_t columns = 1 + data[0] % 64;
  const std::size_t rows = (std::min(size - 2, kMaxCells) + columns - 1) / columns;
  OccupancyGrid grid(columns, rows);
  for (std::size_t i = 0; i < std::min(size - 2, columns * rows); ++i) {
    const std::uint8_t byte = data[2 + i];
    const Cell cell = byte == '#' ? Cell::kOccupied : byte == '?' ? Cell::kUnknown : Cell::kFree;
    grid.set(static_cast<std::int64_t>(i % columns), static_cast<std::int64_t>(i / columns), cell);
  }
  ImportOptions options;
  options.made_by = static_cast<MadeBy>(data[1] % 3);
  options.square = (data[1] & 4U) != 0;
  if ((data[1] & 8U) != 0) options.thin_m = 0.02;
  const double resolution_m = (data[1] & 16U) != 0 ? 0.015 : 0.05;
  ImportResult result = import_grid(grid, resolution_m, {1, 2, 0.3}, options);
  // Throws if they make no map.
  if (!result.plan.walls.empty()) static_cast<void>(cornerd::core::WallMap(std::move(result.plan)));
  return 0;
}
