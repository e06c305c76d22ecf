// SPDX-License-Identifier: MIT
#include "core/map/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/map/extent_tree.hpp"

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

/// The parts of an edge that no box covers.
class VisibleParts {
 public:
  /// `shortest`: a share of the length; shorter parts are left out.
  explicit VisibleParts(double shortest) : shortest_(shortest), parts_{{0, 1}} {}

  bool has_any_of(const Interval& range) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](const Interval& part) {
      return part.begin < range.end && part.end > range.begin;
    });
  }
  std::span<const Interval> parts() const { return parts_; }

  void hide(const Interval& hidden) {
    if (hidden.begin >= hidden.end) return;
    for (std::size_t i = parts_.size(); i-- > 0;) {
      const Interval part = parts_[i];
      if (hidden.end <= part.begin || hidden.begin >= part.end) continue;
      parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
      insert(i, {hidden.end, part.end});
      insert(i, {part.begin, hidden.begin});
    }
  }

 private:
  void insert(std::size_t place, const Interval& part) {
    if (part.end - part.begin <= shortest_) return;
    parts_.insert(parts_.begin() + static_cast<std::ptrdiff_t>(place), part);
  }

  double shortest_;
  std::vector<Interval> parts_;
};

/// Indices by the boxes' direction, then their place across it: neighbours in a bundle or a fan of
/// walls hide most of each other.
std::vector<std::uint32_t> by_direction(std::span<const WallBox> boxes) {
  std::vector<std::tuple<double, double, std::uint32_t>> lines;
  for (const WallBox& box : boxes) {
    lines.emplace_back(std::atan2(box.along.y(), box.along.x()), cross(box.along, box.centre),
                       static_cast<std::uint32_t>(lines.size()));
  }
  std::sort(lines.begin(), lines.end());
  std::vector<std::uint32_t> order;
  for (const auto& line : lines) order.push_back(std::get<2>(line));
  return order;
}

/// A fixed permutation without order: where most boxes cover a point, one of the first does.
std::vector<std::uint32_t> shuffled(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::minstd_rand random(1);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

/// Finds what other boxes hide of a box's edges.
class Visibility {
 public:
  explicit Visibility(std::span<const WallBox> boxes)
      : boxes_(boxes),
        order_(by_direction(boxes)),
        place_(boxes.size()),
        extents_(extents_of(boxes)),
        tree_(extents_, shuffled(boxes.size())) {
    for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = i;
  }

  VisibleParts of(const Edge& edge) {
    const Vec2 way = edge.to - edge.from;
    VisibleParts visible(2 * kGeometryEpsilon_m / way.norm());
    const auto hide_behind = [&](std::uint32_t other) {
      if (other == edge.box) return;
      if (++compared_ > kMaxCompared) throw std::invalid_argument(kTooMany);
      visible.hide(hidden_by(edge, boxes_[edge.box], boxes_[other], other));
    };
    constexpr std::size_t kNeighbours = 4;
    const std::size_t place = place_[edge.box];
    const std::size_t last = std::min(place + kNeighbours, order_.size() - 1);
    for (std::size_t i = place - std::min(place, kNeighbours); i <= last; ++i) {
      hide_behind(order_[i]);
    }
    const std::vector<Interval> open(visible.parts().begin(), visible.parts().end());
    for (const Interval& part : open) {
      tree_.search(edge.from + part.begin * way, edge.from + part.end * way,
                   [&](std::span<const std::uint32_t> others) {
                     for (const std::uint32_t other : others) {
                       hide_behind(other);
                       if (!visible.has_any_of(part)) return false;
                     }
                     return true;
                   });
    }
    return visible;
  }

 private:
  static std::vector<Extent> extents_of(std::span<const WallBox> boxes) {
    std::vector<Extent> extents;
    for (const WallBox& box : boxes) extents.push_back(box.extent());
    return extents;
  }

  std::span<const WallBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> place_;  ///< of each box in order_
  std::vector<Extent> extents_;
  ExtentTree tree_;
  /// Pairs of an edge and a box: seconds on a PC; 100,000 walls of a building have some millions.
  static constexpr std::uint64_t kMaxCompared = 200'000'000;
  static constexpr const char* kTooMany = "too many walls cross each other: hatching, or noise?";
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
  }
  return join_straight(std::move(faces));
}

}  // namespace cornerd::core
