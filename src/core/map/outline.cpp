// SPDX-License-Identifier: MIT
#include "core/map/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/map/extent_tree.hpp"
#include "core/map/line_coverage.hpp"
#include "core/map/visible_parts.hpp"

namespace cornerd::core {
namespace {

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

/// True where the box covers nothing from `from` to `to`, by a look at its four sides.
bool is_beside(const WallBox& box, const Vec2& from, const Vec2& to) {
  const Vec2 reach = Vec2(box.half_length_m, box.half_width_m).array() + 2 * kGeometryEpsilon_m;
  const Vec2 a = box.to_local(from);
  const Vec2 b = box.to_local(to);
  return (a.cwiseMin(b).array() > reach.array()).any() ||
         (a.cwiseMax(b).array() < -reach.array()).any();
}

/// The part of `edge` that `other`, no line wall, covers; empty where begin >= end.
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

/// Those with a thickness, in a fixed permutation without order: where most boxes cover a point,
/// one of the first does.
std::vector<std::uint32_t> shuffled_solids(std::span<const WallBox> boxes) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].is_line()) order.push_back(i);
  }
  std::minstd_rand random(1);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

/// Finds what other boxes hide of a box's edges: all with a thickness, and the line walls added.
class Visibility {
 public:
  explicit Visibility(std::span<const WallBox> boxes)
      : boxes_(boxes),
        extents_(extents_of(boxes)),
        tree_(extents_, shuffled_solids(boxes), covers(boxes)) {}

  VisibleParts of(const Edge& edge) {
    VisibleParts visible(2 * kGeometryEpsilon_m / (edge.to - edge.from).norm());
    if (boxes_[edge.box].is_line()) {
      for (const Interval& covered : lines_.of(edge.from, edge.to)) visible.hide(covered);
    }
    for (const Interval& part : visible.within({0, 1})) hide_behind_solids(edge, part, visible);
    return visible;
  }

  /// The edges of later boxes are hidden where they lie on those of this line wall.
  void add_line(const WallBox& box) { lines_.add(box); }

 private:
  void hide_behind_solids(const Edge& edge, const Interval& range, VisibleParts& visible) {
    const Vec2 way = edge.to - edge.from;
    const Vec2 from = edge.from + range.begin * way;
    const Vec2 to = edge.from + range.end * way;
    // What is left is searched anew: one wall often hides nearly all of the edge.
    const double half = (range.end - range.begin) / 2;
    bool is_halved = false;
    const auto compare = [&](std::span<const std::uint32_t> others) {
      for (const std::uint32_t other : others) {
        if (other == edge.box) continue;
        if (++compared_ > kMaxCompared) throw std::invalid_argument(kTooManyCrossings);
        if (is_beside(boxes_[other], from, to)) continue;
        compared_ += visible.parts().size();
        visible.hide(hidden_by(edge, boxes_[edge.box], boxes_[other], other));
        is_halved = visible.length_within(range) < half;
        if (is_halved) break;
      }
      return !is_halved;
    };
    tree_.search(from, to, compare);
    if (!is_halved) return;
    for (const Interval& part : visible.within(range)) hide_behind_solids(edge, part, visible);
  }

  static ExtentTree::Covers covers(std::span<const WallBox> boxes) {
    return [boxes](std::uint32_t i, const Vec2& centre, double half_m) {
      const Vec2 local = boxes[i].to_local(centre).cwiseAbs();
      const double reach_m = half_m * boxes[i].along.lpNorm<1>();
      return local.x() + reach_m < boxes[i].half_length_m &&
             local.y() + reach_m < boxes[i].half_width_m;
    };
  }
  static std::vector<Extent> extents_of(std::span<const WallBox> boxes) {
    std::vector<Extent> extents;
    for (const WallBox& box : boxes) extents.push_back(box.extent());
    return extents;
  }

  std::span<const WallBox> boxes_;
  std::vector<Extent> extents_;
  ExtentTree tree_;  ///< of the boxes with a thickness
  LineCoverage lines_;
  /// Parts of edges and boxes compared: seconds on a PC; 100,000 walls of a building have some
  /// millions.
  static constexpr std::uint64_t kMaxCompared = 400'000'000;
  std::uint64_t compared_ = 0;
};

/// Equal walls, drawn in either direction, once: the first of them.
std::vector<WallBox> without_copies(std::span<const WallBox> boxes) {
  std::vector<WallBox> kept;
  std::set<std::array<double, 6>> seen;
  for (const WallBox& box : boxes) {
    const bool is_turned = box.along.x() < 0 || (box.along.x() == 0 && box.along.y() < 0);
    const Vec2 along = is_turned ? Vec2(-box.along) : box.along;
    const bool is_new = seen.insert({box.centre.x(), box.centre.y(), along.x(), along.y(),
                                     box.half_length_m, box.half_width_m})
                            .second;
    if (is_new) kept.push_back(box);
  }
  return kept;
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

std::vector<Face> outline_of(std::span<const WallBox> all) {
  const std::vector<WallBox> boxes = without_copies(all);
  std::vector<Face> faces;
  Visibility visibility(boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const Edge& edge : edges_of(boxes[i], i)) {
      const VisibleParts visible = visibility.of(edge);
      for (const Interval& part : visible.parts()) {
        faces.push_back(make_face(edge.from + part.begin * (edge.to - edge.from),
                                  edge.from + part.end * (edge.to - edge.from)));
      }
    }
    if (boxes[i].is_line()) visibility.add_line(boxes[i]);
  }
  return join_straight(std::move(faces));
}

}  // namespace cornerd::core
