// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "core/map/crossings.hpp"
#include "core/map/extent_tree.hpp"
#include "core/map/outline.hpp"

namespace cornerd::core {
namespace {

/// Ends of clipped faces agree to a few rounding errors.
constexpr double kSamePoint_m = 5e-6;
/// Of faces, four where two line walls cross: 20 walls across each of 10,000, a large building's,
/// most of which end at others.
constexpr std::size_t kMaxCrossings = 800'000;
constexpr double kStraight_rad = radians(1);

/// A face that leaves a vertex, and the side of its free space.
struct Arm {
  double angle_rad = 0;
  bool free_on_left = false;
};

/// Points, each once: a hash grid of them.
class PointSet {
 public:
  explicit PointSet(std::size_t expected) { newest_.reserve(expected); }

  void add(const Vec2& point) {
    const auto cell = [](double coordinate) {
      return static_cast<std::int64_t>(std::floor(coordinate / kCell_m));
    };
    for (const double x_m : {point.x() - kCell_m, point.x(), point.x() + kCell_m}) {
      for (const double y_m : {point.y() - kCell_m, point.y(), point.y() + kCell_m}) {
        if (holds(cell(x_m), cell(y_m), point)) return;
      }
    }
    const auto index = static_cast<std::uint32_t>(points_.size());
    auto [newest, is_new] = newest_.try_emplace(key(cell(point.x()), cell(point.y())), index);
    before_.push_back(is_new ? kNone : std::exchange(newest->second, index));
    points_.push_back(point);
  }

  const std::vector<Vec2>& points() const { return points_; }

 private:
  static constexpr double kCell_m = 1e-3;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return static_cast<std::uint64_t>(x) << 32 ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
  }

  bool holds(std::int64_t x, std::int64_t y, const Vec2& point) const {
    const auto newest = newest_.find(key(x, y));
    if (newest == newest_.end()) return false;
    for (std::uint32_t i = newest->second; i != kNone; i = before_[i]) {
      if ((points_[i] - point).norm() < kSamePoint_m) return true;
    }
    return false;
  }

  std::vector<Vec2> points_;
  std::vector<std::uint32_t> before_;  ///< the point before it in the same cell
  std::unordered_map<std::uint64_t, std::uint32_t> newest_;  ///< of a cell
};

/// The ends of all faces and the crossings of line walls, each point once.
std::vector<Vec2> vertices_of(std::span<const Face> faces) {
  PointSet vertices(2 * faces.size());
  for (const Face& face : faces) {
    vertices.add(face.from);
    vertices.add(face.to);
  }
  const auto crossings = crossings_of(faces, kSamePoint_m, kMaxCrossings);
  if (crossings.size() >= kMaxCrossings) throw std::invalid_argument(kTooManyCrossings);
  for (const auto& [i, j] : crossings) {
    const Face& a = faces[i];
    const Face& b = faces[j];
    const double sine = cross(a.direction, b.direction);
    const double along_a = cross(b.from - a.from, b.direction) / sine;
    vertices.add(a.from + along_a * a.direction);
  }
  return vertices.points();
}

void add_arms(const Face& face, const Vec2& vertex, std::vector<Arm>& arms) {
  const double along = face.direction.dot(vertex - face.from);
  if (along < -kSamePoint_m || along > face.length_m + kSamePoint_m) return;
  if (std::abs(face.normal.dot(vertex) - face.offset_m) > kSamePoint_m) return;
  const double angle = std::atan2(face.direction.y(), face.direction.x());
  if (along < face.length_m - kSamePoint_m) arms.push_back({angle, true});
  if (along > kSamePoint_m) arms.push_back({normalize_angle(angle + kPi), false});
}

/// The smallest angle from `begin` counter-clockwise to one of `ends`; more than a revolution where
/// there is none.
double opening_from(double begin_rad, std::span<const double> ends_rad) {
  double opening = 3 * kPi;
  for (const double end_rad : ends_rad) {
    double angle = angle_between(begin_rad, end_rad);
    if (angle < 1e-6) angle += kTwoPi;
    opening = std::min(opening, angle);
  }
  return opening;
}

/// One corner per sector of free space around the vertex, counter-clockwise from the arm where it
/// begins to the arm where it ends.
void add_corners(const Vec2& vertex, std::span<const Arm> arms, std::vector<Corner>& corners) {
  std::vector<double> ends_rad;
  for (const Arm& arm : arms) {
    if (!arm.free_on_left) ends_rad.push_back(arm.angle_rad);
  }
  std::sort(ends_rad.begin(), ends_rad.end());
  // Where a sector may end: the ends around its begin, and the first and the last.
  std::array<double, 6> near_rad;
  for (const Arm& begin : arms) {
    if (!begin.free_on_left) continue;
    std::span<const double> candidates(ends_rad);
    if (ends_rad.size() > near_rad.size()) {
      const auto next = std::upper_bound(ends_rad.begin(), ends_rad.end(), begin.angle_rad + 1e-6);
      const std::ptrdiff_t place = next - ends_rad.begin();
      const auto count = static_cast<std::ptrdiff_t>(ends_rad.size());
      for (std::ptrdiff_t i = 0; i < 4; ++i) {
        near_rad[static_cast<std::size_t>(i)] =
            ends_rad[static_cast<std::size_t>((place + i - 2 + count) % count)];
      }
      near_rad[4] = ends_rad.front();
      near_rad[5] = ends_rad.back();
      candidates = near_rad;
    }
    const double opening = opening_from(begin.angle_rad, candidates);
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
  for (const Face& face : faces) {
    extents.push_back(Extent::of_segment(face.from, face.to, kSamePoint_m));
  }
  ExtentTree tree(extents);
  std::vector<std::uint32_t> near;
  for (const Vec2& vertex : vertices_of(faces)) {
    near.clear();
    tree.search(vertex, vertex, [&](std::span<const std::uint32_t> some) {
      near.insert(near.end(), some.begin(), some.end());
      return true;
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    arms.clear();
    for (const std::uint32_t i : near) add_arms(faces[i], vertex, arms);
    add_corners(vertex, arms, corners);
  }
  return corners;
}

}  // namespace cornerd::core
