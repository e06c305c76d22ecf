// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "core/map/outline.hpp"

namespace cornerd::core {
namespace {

/// Ends of clipped faces agree to a few rounding errors.
constexpr double kSamePoint_m = 5e-6;
constexpr double kStraight_rad = radians(1);

/// A face that leaves a vertex, and the side of its free space.
struct Arm {
  double angle_rad = 0;
  bool free_on_left = false;
};

/// A hash grid for finding neighbours of a point.
class Grid {
 public:
  explicit Grid(double cell_m) : cell_m_(cell_m) {}

  void insert(const Vec2& point, std::size_t index) { cells_[key(point)].push_back(index); }

  template <typename Visitor>
  void visit_near(const Vec2& point, Visitor&& visit) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto found = cells_.find(key(point + cell_m_ * Vec2(dx, dy)));
        if (found == cells_.end()) continue;
        for (const std::size_t index : found->second) visit(index);
      }
    }
  }

 private:
  std::uint64_t key(const Vec2& point) const {
    const auto x = static_cast<std::int64_t>(std::floor(point.x() / cell_m_));
    const auto y = static_cast<std::int64_t>(std::floor(point.y() / cell_m_));
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
  }
  double cell_m_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// The ends of all faces and the crossings of line walls, each point once.
std::vector<Vec2> vertices_of(std::span<const Face> faces, const CellGrid& grid_of_faces) {
  std::vector<Vec2> vertices;
  Grid grid(1e-3);
  const auto add = [&](const Vec2& point) {
    bool known = false;
    grid.visit_near(point, [&](std::size_t i) {
      known = known || (vertices[i] - point).norm() < kSamePoint_m;
    });
    if (known) return;
    grid.insert(point, vertices.size());
    vertices.push_back(point);
  };
  for (const Face& face : faces) {
    add(face.from);
    add(face.to);
  }
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    const Face& a = faces[i];
    grid_of_faces.collect(Extent::of_segment(a.from, a.to, 0), near);
    for (const std::uint32_t j : near) {
      if (j <= i) continue;
      const Face& b = faces[j];
      const double sine = cross(a.direction, b.direction);
      if (std::abs(sine) < 1e-9) continue;
      const double along_a = cross(b.from - a.from, b.direction) / sine;
      if (along_a < kSamePoint_m || along_a > a.length_m - kSamePoint_m) continue;
      const double along_b = cross(b.from - a.from, a.direction) / sine;
      if (along_b < kSamePoint_m || along_b > b.length_m - kSamePoint_m) continue;
      add(a.from + along_a * a.direction);
    }
  }
  return vertices;
}

void add_arms(const Face& face, const Vec2& vertex, std::vector<Arm>& arms) {
  const double along = face.direction.dot(vertex - face.from);
  if (along < -kSamePoint_m || along > face.length_m + kSamePoint_m) return;
  if (std::abs(face.normal.dot(vertex) - face.offset_m) > kSamePoint_m) return;
  const double angle = std::atan2(face.direction.y(), face.direction.x());
  if (along < face.length_m - kSamePoint_m) arms.push_back({angle, true});
  if (along > kSamePoint_m) arms.push_back({normalize_angle(angle + kPi), false});
}

/// One corner per sector of free space around the vertex, counter-clockwise from the arm where it
/// begins to the arm where it ends.
void add_corners(const Vec2& vertex, std::span<const Arm> arms, std::vector<Corner>& corners) {
  for (const Arm& begin : arms) {
    if (!begin.free_on_left) continue;
    double opening = 3 * kPi;
    for (const Arm& end : arms) {
      if (end.free_on_left) continue;
      double angle = angle_between(begin.angle_rad, end.angle_rad);
      if (angle < 1e-6) angle += kTwoPi;
      opening = std::min(opening, angle);
    }
    if (opening > 2.5 * kPi || std::abs(opening - kPi) < kStraight_rad) continue;
    Corner corner;
    corner.position = vertex;
    corner.opening_rad = opening;
    corner.left_face_rad = begin.angle_rad;
    corner.right_face_rad = normalize_angle(begin.angle_rad + opening);
    corners.push_back(corner);
  }
}

}  // namespace

std::vector<Corner> corners_of(std::span<const Face> faces) {
  std::vector<Corner> corners;
  std::vector<Arm> arms;
  std::vector<Extent> extents;
  for (const Face& face : faces) extents.push_back(Extent::of_segment(face.from, face.to, 0));
  const CellGrid grid(extents);
  std::vector<std::uint32_t> near;
  for (const Vec2& vertex : vertices_of(faces, grid)) {
    arms.clear();
    grid.collect(Extent::of_segment(vertex, vertex, kSamePoint_m), near);
    for (const std::uint32_t i : near) add_arms(faces[i], vertex, arms);
    add_corners(vertex, arms, corners);
  }
  return corners;
}

}  // namespace cornerd::core
