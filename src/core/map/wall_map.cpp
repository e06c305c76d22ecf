// SPDX-License-Identifier: MIT
#include "core/map/wall_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/map/extent_tree.hpp"
#include "core/map/outline.hpp"
#include "core/map/polygon.hpp"

namespace cornerd::core {
namespace {

/// Ends of walls and the corners there agree to a few rounding errors.
constexpr double kSameEnd_m = 5e-6;

void check(const Wall& wall, std::size_t index) {
  const auto fail = [&](const char* reason) {
    throw std::invalid_argument("wall " + std::to_string(index) + ": " + reason);
  };
  if (!wall.from.allFinite() || !wall.to.allFinite() || !std::isfinite(wall.thickness_m)) {
    fail("a number is not finite");
  }
  if (wall.thickness_m < 0) fail("its thickness is negative");
  if (wall.thickness_m == 0 && (wall.to - wall.from).norm() < 1e-3) {
    fail("it has neither length nor thickness");
  }
}

/// An end of a wall that goes on there.
struct OpenEnd {
  WallBox box;
  double side;  ///< 1 at the wall's `to`, -1 at its `from`

  Extent extent() const {
    const Vec2 end = box.centre + side * box.half_length_m * box.along;
    const Vec2 across = box.half_width_m * rotate_left(box.along);
    return Extent::of_segment(end - across, end + across, kSameEnd_m);
  }
  bool holds(const Vec2& point) const {
    const Vec2 local = box.to_local(point);
    return std::abs(side * local.x() - box.half_length_m) < kSameEnd_m &&
           std::abs(local.y()) < box.half_width_m + kSameEnd_m;
  }
};

}  // namespace

WallMap::WallMap(FloorPlan plan) : plan_(std::move(plan)) {
  std::vector<WallBox> boxes;
  for (std::size_t i = 0; i < plan_.walls.size(); ++i) {
    check(plan_.walls[i], i);
    boxes.emplace_back(plan_.walls[i]);
  }
  faces_ = outline_of(boxes);
  if (faces_.empty()) throw std::invalid_argument("the map has no walls");
  corners_ = corners_of(faces_);
  lower_left_ = upper_right_ = faces_.front().from;
  for (const Face& face : faces_) {
    lower_left_ = lower_left_.cwiseMin(face.from).cwiseMin(face.to);
    upper_right_ = upper_right_.cwiseMax(face.from).cwiseMax(face.to);
  }
  index();
  assign_sigmas();
  remove_open_ends();
}

void WallMap::remove_open_ends() {
  std::vector<OpenEnd> ends;
  std::vector<Extent> extents;
  for (const Wall& wall : plan_.walls) {
    const WallBox box(wall);
    for (const double side : {-1.0, 1.0}) {
      if (!wall.is_open[side > 0 ? 1 : 0]) continue;
      ends.push_back({box, side});
      extents.push_back(ends.back().extent());
    }
  }
  if (ends.empty()) return;
  ExtentTree tree(extents);
  std::erase_if(corners_, [&](const Corner& corner) {
    bool is_open = false;
    tree.search(corner.position, corner.position, [&](std::span<const std::uint32_t> near) {
      is_open = std::any_of(near.begin(), near.end(),
                            [&](std::uint32_t i) { return ends[i].holds(corner.position); });
      return !is_open;
    });
    return is_open;
  });
}

void WallMap::assign_sigmas() {
  std::vector<WallBox> boxes;
  std::vector<double> sigmas_m;
  std::vector<Extent> extents;
  for (const Wall& wall : plan_.walls) {
    if (!wall.sigma_m) continue;
    boxes.emplace_back(wall);
    sigmas_m.push_back(*wall.sigma_m);
    extents.push_back(boxes.back().extent());
  }
  if (boxes.empty()) return;
  ExtentTree tree(extents);
  for (Face& face : faces_) {
    const Vec2 behind = (face.from + face.to) / 2 - kGeometryEpsilon_m * face.normal;
    tree.search(behind, behind, [&](std::span<const std::uint32_t> near) {
      for (const std::uint32_t i : near) {
        const Vec2 local = boxes[i].to_local(behind);
        if (std::abs(local.x()) > boxes[i].half_length_m + kGeometryEpsilon_m) continue;
        if (std::abs(local.y()) > boxes[i].half_width_m + 2 * kGeometryEpsilon_m) continue;
        face.sigma_m = std::max(face.sigma_m, sigmas_m[i]);
      }
      return true;
    });
  }
}

void WallMap::index() {
  std::vector<Extent> extents;
  for (const Face& face : faces_) extents.push_back(Extent::of_segment(face.from, face.to, 0));
  face_grid_ = CellGrid(extents);
  extents.clear();
  for (const Wall& wall : plan_.walls) extents.push_back(WallBox(wall).extent());
  wall_grid_ = CellGrid(extents);
  extents.clear();
  for (const Room& room : plan_.rooms) {
    Extent extent{room.polygon.front(), room.polygon.front()};
    for (const Vec2& point : room.polygon) {
      extent.low = extent.low.cwiseMin(point);
      extent.high = extent.high.cwiseMax(point);
    }
    extents.push_back(extent);
  }
  room_grid_ = CellGrid(extents);
}

std::size_t WallMap::memory_bytes() const {
  return faces_.capacity() * sizeof(Face) + corners_.capacity() * sizeof(Corner) +
         face_grid_.memory_bytes() + wall_grid_.memory_bytes() + room_grid_.memory_bytes();
}

std::optional<std::size_t> WallMap::room_at(const Vec2& point) const {
  for (const std::uint32_t i : room_grid_.at(point)) {
    if (contains(plan_.rooms[i].polygon, point)) return i;
  }
  return std::nullopt;
}

bool WallMap::is_solid(const Vec2& point) const {
  const auto walls = wall_grid_.at(point);
  return std::any_of(walls.begin(), walls.end(), [&](std::uint32_t i) {
    const Wall& wall = plan_.walls[i];
    if (wall.thickness_m == 0) return false;
    const WallBox box(wall);
    const Vec2 local = box.to_local(point);
    return std::abs(local.x()) < box.half_length_m && std::abs(local.y()) < box.half_width_m;
  });
}

double WallMap::range_along(const Vec2& origin, double angle_rad, double max_range_m) const {
  const Vec2 ray = unit_vector(angle_rad);
  double nearest_m = max_range_m;
  bool hit = false;
  const auto meet = [&](const Face& face) {
    const double approach = -face.normal.dot(ray);
    const double height_m = face.normal.dot(origin) - face.offset_m;
    if (approach <= 1e-12 || height_m <= 0 || height_m > nearest_m * approach) return;
    const double range_m = height_m / approach;
    const double along_m = face.direction.dot(origin + range_m * ray - face.from);
    if (along_m < 0 || along_m > face.length_m) return;
    nearest_m = range_m;
    hit = true;
  };
  face_grid_.walk(origin, ray, max_range_m,
                  [&](std::span<const std::uint32_t> faces, double leaves_m) {
                    for (const std::uint32_t i : faces) meet(faces_[i]);
                    return !hit || nearest_m > leaves_m;
                  });
  return hit ? nearest_m : 0;
}

}  // namespace cornerd::core
