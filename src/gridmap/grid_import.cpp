// SPDX-License-Identifier: MIT
#include "gridmap/grid_import.hpp"

#include <algorithm>
#include <cmath>

#include "gridmap/cleaning.hpp"
#include "gridmap/faces.hpp"
#include "gridmap/solids.hpp"
#include "gridmap/walls.hpp"

namespace cornerd::gridmap {
namespace {

/// Mapped walls are one or two cells thick.
constexpr double kDrawnBuriedShare = 0.25;
/// Patches of two cells are noise at any resolution.
constexpr double kSpeckCells = 2.5;
/// Deviation of a straight line's border in a drawing, and in a mapped picture, in cells.
constexpr double kDrawnTolerance = 0.75;
constexpr double kMappedTolerance = 1.25;
constexpr double kBlock_m = 2;
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
    return {place(cells.from), place(cells.to), cells.thickness_m * resolution_m_};
  }
  Remark remark(const core::Vec2& centre, double size) const {
    return {place(centre), size * resolution_m_};
  }

 private:
  double resolution_m_;
  core::Pose2 T_map_picture_;
};

}  // namespace

MadeBy detect_maker(const OccupancyGrid& grid) {
  if (grid.count(Cell::kUnknown) == 0) return MadeBy::kDrawing;
  return buried_share(grid) > kDrawnBuriedShare ? MadeBy::kDrawing : MadeBy::kLidar;
}

ImportResult import_grid(OccupancyGrid grid, double resolution_m, const core::Pose2& T_map_picture,
                         const ImportOptions& options) {
  const Placer placer(resolution_m, T_map_picture);
  const auto cells = [&](double length_m) { return length_m / resolution_m; };

  ImportResult result;
  result.made_by = options.made_by == MadeBy::kUnknown ? detect_maker(grid) : options.made_by;
  const double min_size = std::max(kSpeckCells, cells(options.speck_m));
  for (const Patch& patch : drop_specks(grid, min_size)) {
    result.specks.push_back(placer.remark(patch.centre, patch.size));
  }
  const double pocket_cells = options.pocket_m2 / (resolution_m * resolution_m);
  for (const Patch& patch : drop_pockets(grid, static_cast<std::size_t>(pocket_cells))) {
    result.pockets.push_back(placer.remark(patch.centre, patch.size));
  }

  const bool is_drawn = result.made_by == MadeBy::kDrawing;
  FaceOptions face_options;
  face_options.tolerance =
      is_drawn ? kDrawnTolerance : std::max(kMappedTolerance, cells(options.roughness_m));
  face_options.inset = is_drawn ? 0 : 0.5;
  face_options.join_gap = cells(options.join_gap_m);
  face_options.square = options.square;
  const FaceSet set = build_faces(grid, trace_borders(grid), face_options);
  for (const JoinedGap& gap : set.gaps) {
    result.joined_gaps.push_back(placer.remark(gap.centre, gap.length));
  }

  SolidLimits limits;
  limits.thickness = cells(options.thickness_m);
  limits.block = std::max(limits.thickness, cells(kBlock_m));
  limits.tolerance = std::max(limits.tolerance, face_options.tolerance / 2);
  limits.thin = cells(options.thin_m);
  limits.into = cells(kInto_m);
  const std::vector<core::Wall> solids = find_solids(grid, set.faces, limits);
  std::vector<LeftOut> left_out;
  const std::vector<core::Wall> one_sided =
      find_one_sided(grid, set.faces, solids, limits, min_size, left_out);
  for (const LeftOut& piece : left_out) {
    result.short_pieces.push_back(placer.remark(piece.centre, piece.size));
  }
  for (const core::Wall& wall : solids) {
    result.plan.walls.push_back(placer.wall(wall));
    ++result.two_sided;
  }
  for (const core::Wall& wall : one_sided) result.plan.walls.push_back(placer.wall(wall));
  return result;
}

}  // namespace cornerd::gridmap
