// SPDX-License-Identifier: MIT
#include "core/map/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cornerd::core {
namespace {

/// Part of an edge, as shares of its length.
struct Interval {
  double begin = 0;
  double end = 1;
};

struct Edge {
  Vec2 from;
  Vec2 to;
  std::size_t box;
};

Face make_face(const Vec2& from, const Vec2& to) {
  Face face;
  face.from = from;
  face.to = to;
  face.length_m = (to - from).norm();
  face.direction = (to - from) / face.length_m;
  face.normal = rotate_left(face.direction);
  face.offset_m = face.normal.dot(from);
  return face;
}

std::vector<Edge> edges_of(const WallBox& box, std::size_t index) {
  const Vec2 u = box.along * box.half_length_m;
  const Vec2 v = rotate_left(box.along) * box.half_width_m;
  const Vec2 a = box.centre - u - v;
  const Vec2 b = box.centre + u - v;
  const Vec2 c = box.centre + u + v;
  const Vec2 d = box.centre - u + v;
  if (box.is_line()) return {{a, b, index}, {b, a, index}};
  return {{b, a, index},
          {c, b, index},
          {d, c, index},
          {a, d, index}};  // clockwise: free space on the left
}

/// Clips [begin, end] to where start + t * slope lies in [-limit, limit].
bool clip(double start, double slope, double limit, Interval& interval) {
  if (std::abs(slope) < kGeometryEpsilon_m) return std::abs(start) <= limit;
  double t0 = (-limit - start) / slope;
  double t1 = (limit - start) / slope;
  if (t0 > t1) std::swap(t0, t1);
  interval.begin = std::max(interval.begin, t0);
  interval.end = std::min(interval.end, t1);
  return interval.begin < interval.end;
}

/// True where `edge` runs along one side of `box`, at the given height above its middle.
bool runs_along(double start, double slope, double half_extent) {
  return std::abs(slope) < kGeometryEpsilon_m &&
         std::abs(std::abs(start) - half_extent) < kGeometryEpsilon_m;
}

/// The part of `edge` that `other` covers; empty where begin >= end.
Interval hidden_by(const Edge& edge, const WallBox& own, const WallBox& other,
                   std::size_t other_index) {
  constexpr Interval kNothing{0, 0};
  const Vec2 a = other.to_local(edge.from);
  const Vec2 d = other.to_local(edge.to) - a;
  Interval inside;
  if (!clip(a.x(), d.x(), other.half_length_m + kGeometryEpsilon_m, inside) ||
      !clip(a.y(), d.y(), other.half_width_m + kGeometryEpsilon_m, inside)) {
    return kNothing;
  }
  if (other.is_line()) {
    const bool same_line = std::abs(d.y()) < kGeometryEpsilon_m;
    return own.is_line() && same_line && other_index < edge.box ? inside : kNothing;
  }
  if (own.is_line()) return inside;
  const bool along_length = runs_along(a.y(), d.y(), other.half_width_m);
  const bool along_width = runs_along(a.x(), d.x(), other.half_length_m);
  if (along_length || along_width) {
    // On the other's surface. With equal normals it is one surface, kept once; with opposite
    // normals the two walls touch and nothing is visible between them.
    const Vec2 normal = rotate_left(d);
    const bool same_way = along_length ? normal.y() * a.y() > 0 : normal.x() * a.x() > 0;
    return same_way && other_index > edge.box ? kNothing : inside;
  }
  return inside;
}

/// [0, 1] without the given intervals, which may overlap.
std::vector<Interval> remaining(std::vector<Interval> hidden) {
  std::sort(hidden.begin(), hidden.end(),
            [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
  std::vector<Interval> left;
  double reached = 0;
  for (const Interval& piece : hidden) {
    if (piece.begin > reached) left.push_back({reached, piece.begin});
    reached = std::max(reached, piece.end);
  }
  if (reached < 1) left.push_back({reached, 1});
  return left;
}

/// A cheap bounding-circle test: no false negatives.
bool may_touch(const WallBox& a, const WallBox& b) {
  const double radius = a.half_length_m + a.half_width_m + b.half_length_m + b.half_width_m;
  return (a.centre - b.centre).squaredNorm() <= (radius + 1e-3) * (radius + 1e-3);
}

/// Joins collinear faces that continue each other: a wall drawn in pieces is one wall.
std::vector<Face> join_straight(std::vector<Face> faces) {
  const auto line_order = [](const Face& a, const Face& b) {
    const auto key = [](const Face& f) {
      constexpr double kGrid = 1e-5;
      return std::array{std::round(f.normal.x() / kGrid), std::round(f.normal.y() / kGrid),
                        std::round(f.offset_m / kGrid)};
    };
    const auto key_a = key(a);
    const auto key_b = key(b);
    if (key_a != key_b) return key_a < key_b;
    return a.direction.dot(a.from) < b.direction.dot(b.from);
  };
  std::sort(faces.begin(), faces.end(), line_order);
  std::vector<Face> joined;
  for (const Face& face : faces) {
    if (!joined.empty()) {
      const Face& last = joined.back();
      const bool continues = (last.to - face.from).norm() < 5 * kGeometryEpsilon_m &&
                             std::abs(cross(last.direction, face.direction)) < 1e-5 &&
                             last.direction.dot(face.direction) > 0;
      if (continues) {
        joined.back() = make_face(last.from, face.to);
        continue;
      }
    }
    joined.push_back(face);
  }
  return joined;
}

}  // namespace

WallBox::WallBox(const Wall& wall) {
  const Vec2 displacement = wall.to - wall.from;
  const double length = displacement.norm();
  centre = (wall.from + wall.to) / 2;
  if (length > 0) along = displacement / length;
  half_width_m = wall.thickness_m / 2;
  half_length_m = length / 2 + half_width_m;
}

Vec2 WallBox::to_local(const Vec2& point) const {
  const Vec2 d = point - centre;
  return {along.dot(d), cross(along, d)};
}

Extent WallBox::extent() const {
  const Vec2 half = half_length_m * along;
  return Extent::of_segment(centre - half, centre + half, half_width_m + kGeometryEpsilon_m);
}

std::vector<Face> outline_of(std::span<const WallBox> boxes) {
  std::vector<Face> faces;
  std::vector<std::uint32_t> near;
  std::vector<Interval> hidden;
  std::vector<Extent> extents;
  for (const WallBox& box : boxes) extents.push_back(box.extent());
  const CellGrid grid(extents);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    grid.collect(extents[i], near);
    std::erase_if(near, [&](std::uint32_t j) { return j == i || !may_touch(boxes[i], boxes[j]); });
    for (const Edge& edge : edges_of(boxes[i], i)) {
      hidden.clear();
      for (const std::uint32_t j : near) {
        const Interval piece = hidden_by(edge, boxes[i], boxes[j], j);
        if (piece.begin < piece.end) hidden.push_back(piece);
      }
      const double length = (edge.to - edge.from).norm();
      for (const Interval& piece : remaining(hidden)) {
        if ((piece.end - piece.begin) * length <= 2 * kGeometryEpsilon_m) continue;
        faces.push_back(make_face(edge.from + piece.begin * (edge.to - edge.from),
                                  edge.from + piece.end * (edge.to - edge.from)));
      }
    }
  }
  return join_straight(std::move(faces));
}

}  // namespace cornerd::core
