// SPDX-License-Identifier: MIT
#include "gridmap/open_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/map/cell_grid.hpp"
#include "core/map/outline.hpp"

namespace cornerd::gridmap {
namespace {

using core::Vec2;

/// Of a face's end to the wall's: the raster's error, and that of the corner of two faces.
constexpr double kSameEnd = 2;
/// Walls and faces at a larger angle (15 degrees) are not parallel.
constexpr double kParallelSine = 0.26;
constexpr double kBeyondStep = 0.5;
constexpr double kTouch = 1;

struct FaceEnd {
  Vec2 place = Vec2::Zero();
  Vec2 outward = Vec2::Zero();
  bool is_open = false;
};

/// Beyond an end that was seen, a border's raster away from it, are free cells.
bool is_free_beyond(const OccupancyGrid& grid, const Vec2& end, const Vec2& outward, double reach) {
  for (double s = 1; s <= reach; s += kBeyondStep) {
    if (grid.at(Vec2(end + s * outward)) == Cell::kFree) return true;
  }
  return false;
}

double distance_to(const core::WallBox& box, const Vec2& point) {
  const Vec2 local = box.to_local(point).cwiseAbs();
  return (local - Vec2(box.half_length_m, box.half_width_m)).cwiseMax(0).norm();
}

}  // namespace

void mark_open_ends(const OccupancyGrid& grid, std::span<const GridFace> faces, double reach,
                    std::span<core::Wall> walls) {
  std::vector<FaceEnd> ends;
  std::vector<core::Extent> extents;
  for (const GridFace& face : faces) {
    for (const bool at_end : {false, true}) {
      const Vec2 place = at_end ? face.to : face.from;
      const Vec2 outward = at_end ? face.direction : Vec2(-face.direction);
      ends.push_back({place, outward, !is_free_beyond(grid, place, outward, reach)});
      extents.push_back(core::Extent::of_segment(place, place, kSameEnd));
    }
  }
  const core::CellGrid end_places(extents);
  std::vector<core::WallBox> boxes;
  extents.clear();
  for (const core::Wall& wall : walls) {
    boxes.emplace_back(wall);
    extents.push_back(core::Extent::of_segment(wall.from, wall.to, wall.thickness_m / 2 + kTouch));
  }
  const core::CellGrid wall_places(extents);
  std::vector<std::uint32_t> near;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (const bool at_end : {false, true}) {
      const core::WallBox& box = boxes[i];
      const Vec2 outward = at_end ? box.along : Vec2(-box.along);
      const Vec2 place = box.centre + box.half_length_m * outward;
      const Vec2 across = box.half_width_m * core::rotate_left(box.along);
      wall_places.collect(core::Extent::of_segment(place, place, 0), near);
      if (std::any_of(near.begin(), near.end(), [&](std::uint32_t j) {
            return j != i && distance_to(boxes[j], place) < kTouch;
          })) {
        continue;
      }
      end_places.collect(core::Extent::of_segment(place - across, place + across, kSameEnd), near);
      bool is_open = false;
      bool is_seen = false;
      for (const std::uint32_t j : near) {
        const FaceEnd& end = ends[j];
        const Vec2 local = box.to_local(end.place).cwiseAbs();
        if (end.outward.dot(outward) < 0 ||
            std::abs(core::cross(end.outward, outward)) > kParallelSine ||
            std::abs(local.x() - box.half_length_m) > kSameEnd ||
            local.y() > box.half_width_m + kSameEnd) {
          continue;
        }
        (end.is_open ? is_open : is_seen) = true;
      }
      walls[i].is_open[at_end ? 1 : 0] = is_open && !is_seen;
    }
  }
}

}  // namespace cornerd::gridmap
