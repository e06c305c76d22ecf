// SPDX-License-Identifier: MIT
#include "gridmap/grid_import.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gridmap/cleaning.hpp"
#include "gridmap/clutter.hpp"
#include "gridmap/face_corners.hpp"
#include "gridmap/faces.hpp"
#include "gridmap/line_search.hpp"
#include "gridmap/open_ends.hpp"
#include "gridmap/solids.hpp"
#include "gridmap/walls.hpp"

namespace cornerd::gridmap {
namespace {

/// Share of straight borders. Drawings have 0.97 to 1. Mappers: a real one 0.7, simulated ones 0.5
/// to 0.99 by noise and number of scans. Below this share, borders give false corners.
constexpr double kSmoothShare = 0.9;
/// Fewer straight borders, those of specks included, are dots: a recorded floor has 0.46 at 3 cm,
/// an apartment 0.01 at 1 cm and 0.23 at 2 cm.
constexpr double kLeastStraight = 0.4;
constexpr double kCoarsest_m = 0.05;
/// The same of the backs of walls. Drawings of thick walls have 1, simulated mappers 0.6 to 0.97.
constexpr double kDrawnBacks = 0.98;
/// Mapped walls are one or two cells thick.
constexpr double kDrawnBuriedShare = 0.25;
/// Patches of two cells are noise at any resolution.
constexpr double kSpeckCells = 2.5;
/// Standard deviation of the walls of a rough map: a recorded floor has 31 mm on its hits, the
/// lidar's noise included.
constexpr double kRoughSigma_m = 0.04;
/// The same of a smooth one: simulated mappers give 5 mm (poses off by 5 mm) to 30 mm (by 3 cm).
constexpr double kMappedSigma_m = 0.02;
/// Deviation of a straight line's border in a drawing, and in a mapped picture, in cells.
constexpr double kDrawnTolerance = 0.75;
constexpr double kMappedTolerance = 1.25;
/// Largest gap of free cells in a mapped wall: narrower than any opening for a robot.
constexpr double kHole_m = 0.1;
constexpr double kHoleCells = 3;
constexpr double kBlock_m = 2;
/// Free cells so near beyond the end of a wall show that it ends there.
constexpr double kBeyond_m = 0.15;
constexpr double kBeyondCells = 3;
/// Overlap of walls that meet, so that no ray passes through the joint.
constexpr double kInto_m = 0.001;

class Placer {
 public:
  Placer(double resolution_m, const core::Pose2& T_map_picture)
      : resolution_m_(resolution_m), T_map_picture_(T_map_picture) {}

  core::Vec2 place(const core::Vec2& cells) const {
    return T_map_picture_ * core::Vec2(cells * resolution_m_);
  }
  core::Wall wall(const core::Wall& cells) const {
    return {
        place(cells.from), place(cells.to), cells.thickness_m * resolution_m_, {}, cells.is_open};
  }
  Remark remark(const core::Vec2& centre, double size) const {
    return {place(centre), size * resolution_m_};
  }

 private:
  double resolution_m_;
  core::Pose2 T_map_picture_;
};

/// Unknown and free cells exchanged: its borders are the backs of the walls.
OccupancyGrid from_behind(const OccupancyGrid& grid) {
  OccupancyGrid behind = grid;
  for (std::int64_t row = 0; row < grid.rows(); ++row) {
    for (std::int64_t column = 0; column < grid.columns(); ++column) {
      const Cell cell = grid.at(column, row);
      if (cell == Cell::kOccupied) continue;
      behind.set(column, row, cell == Cell::kFree ? Cell::kUnknown : Cell::kFree);
    }
  }
  return behind;
}

/// A drawing has straight borders, and no cell is unknown, or many occupied cells cannot have been
/// reached by beams. A mapped wall that is so thick has a ragged back: the farthest of many beams.
bool is_drawn(const OccupancyGrid& grid, bool is_smooth) {
  if (!is_smooth || grid.count(Cell::kUnknown) == 0) return is_smooth;
  return buried_share(grid) > kDrawnBuriedShare &&
         straightness(from_behind(grid)).of_long > kDrawnBacks;
}

/// The grid in the finest cells in which it has walls: cells finer than a mapper's noise are dots.
void join_cells(OccupancyGrid& grid, double& resolution_m) {
  double best = straightness(grid).of_all;
  const OccupancyGrid finest = grid;
  const double finest_m = resolution_m;
  for (std::int64_t factor = 2; best < kLeastStraight; ++factor) {
    const double size_m = static_cast<double>(factor) * finest_m;
    if (size_m > kCoarsest_m) break;
    OccupancyGrid coarse = coarser(finest, factor);
    const double share = straightness(coarse).of_all;
    if (share <= best) continue;
    best = share;
    grid = std::move(coarse);
    resolution_m = size_m;
  }
}

}  // namespace

ImportResult import_grid(OccupancyGrid grid, double resolution_m, const core::Pose2& T_map_picture,
                         const ImportOptions& options) {
  if (options.made_by != MadeBy::kDrawing) join_cells(grid, resolution_m);
  const Placer placer(resolution_m, T_map_picture);
  const auto cells = [&](double length_m) { return length_m / resolution_m; };
  ImportResult result;
  result.cell_m = resolution_m;
  const auto remark = [&](const std::vector<Patch>& patches, std::vector<Remark>& remarks) {
    for (const Patch& patch : patches) remarks.push_back(placer.remark(patch.centre, patch.size));
  };

  const bool is_smooth = straightness(grid).of_long > kSmoothShare;
  result.made_by = options.made_by != MadeBy::kUnknown ? options.made_by
                   : is_drawn(grid, is_smooth)         ? MadeBy::kDrawing
                                                       : MadeBy::kLidar;
  const bool by_drawing = result.made_by == MadeBy::kDrawing;
  const bool is_rough = !by_drawing && !is_smooth;
  const double min_size = std::max(kSpeckCells, cells(options.speck_m));
  // In a rough map, specks may be parts of walls.
  if (!is_rough) remark(drop_specks(grid, min_size), result.specks);
  const double pocket_cells = options.pocket_m2 / (resolution_m * resolution_m);
  remark(drop_pockets(grid, static_cast<std::size_t>(pocket_cells)), result.pockets);

  const double tolerance =
      by_drawing ? kDrawnTolerance : std::max(kMappedTolerance, cells(options.roughness_m));
  SolidLimits limits;
  limits.thickness = cells(options.thickness_m);
  limits.block = std::max(limits.thickness, cells(kBlock_m));
  limits.tolerance = std::max(limits.tolerance, tolerance / 2);
  limits.thin = cells(options.thin_m);
  limits.into = cells(kInto_m);

  result.plan.sigma_m = std::max({result.plan.sigma_m, resolution_m / 2,
                                  by_drawing ? 0
                                  : is_rough ? kRoughSigma_m
                                             : kMappedSigma_m});
  FaceSet set;
  std::vector<core::Wall> boxes;
  if (is_rough) {
    LineSearchOptions search;
    search.tolerance = tolerance;
    search.join_gap = cells(options.join_gap_m);
    search.max_hole = std::max(kHoleCells, cells(kHole_m));
    MappedLines lines = find_lines(grid, search);
    OccupancyGrid rest = grid;
    const double reach = lines.inset + tolerance + 1;
    draw_bands(lines.faces, {-reach, reach}, Cell::kUnknown, rest);
    draw_bands(lines.faces, {-lines.inset, 0}, Cell::kOccupied, grid);
    Clutter clutter = box_clutter(rest, min_size, lines.inset, limits);
    remark(clutter.dropped, result.specks);
    boxes = std::move(clutter.walls);
    join_corners(grid, reach, search.join_gap, lines.faces);
    set = {std::move(lines.faces), std::move(lines.gaps)};
    limits.lines = true;
    limits.wedge = tolerance;
  } else {
    FaceOptions face_options;
    face_options.tolerance = tolerance;
    face_options.inset = by_drawing ? 0 : 0.5;
    face_options.join_gap = cells(options.join_gap_m);
    face_options.square = options.square;
    set = build_faces(grid, trace_borders(grid), face_options);
  }
  for (const JoinedGap& gap : set.gaps) {
    result.joined_gaps.push_back(placer.remark(gap.centre, gap.length));
  }

  std::vector<core::Wall> walls = find_solids(grid, set.faces, limits);
  result.two_sided = walls.size();
  std::vector<LeftOut> left_out;
  for (const core::Wall& wall :
       find_one_sided(grid, set.faces, walls, limits, min_size, left_out)) {
    walls.push_back(wall);
  }
  mark_open_ends(grid, set.faces, std::max(kBeyondCells, cells(kBeyond_m)), walls);
  for (const LeftOut& piece : left_out) {
    result.short_pieces.push_back(placer.remark(piece.centre, piece.size));
  }
  result.rectangles = boxes.size();
  walls.insert(walls.end(), boxes.begin(), boxes.end());
  for (const core::Wall& wall : walls) result.plan.walls.push_back(placer.wall(wall));
  return result;
}

}  // namespace cornerd::gridmap
