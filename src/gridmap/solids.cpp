// SPDX-License-Identifier: MIT
#include "gridmap/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace cornerd::gridmap {
namespace {

using core::Vec2;

constexpr double kLookStep = 0.5;  ///< sampling step along a wall
constexpr double kMargin = 1;      ///< raster error at a face
constexpr double kMinOverlap = 1;
/// A face covered by walls over this share of its length needs no other.
constexpr double kEnough = 0.9;

/// Two faces that may belong to one wall, in the wall's axes.
struct Candidate {
  std::size_t front = 0;
  std::size_t back = 0;
  Vec2 origin = Vec2::Zero();  ///< on the wall's axis
  Vec2 direction = Vec2::Zero();
  double thickness = 0;
  Interval both;  ///< along the axis: where both faces are
  Interval all;   ///< where any of them is
};

std::optional<Candidate> match(const GridFace& front, const GridFace& back,
                               const SolidLimits& limits) {
  if (front.direction.dot(back.direction) > -0.97) return std::nullopt;
  Candidate candidate;
  candidate.direction = (front.direction - back.direction).normalized();
  const Vec2 normal = core::rotate_left(candidate.direction);
  const auto along = [&](const Vec2& point) { return candidate.direction.dot(point - front.from); };
  const Interval a{along(front.from), along(front.to)};
  const Interval b{along(back.to), along(back.from)};
  candidate.both = {std::max(a.begin, b.begin), std::min(a.end, b.end)};
  candidate.all = {std::min(a.begin, b.begin), std::max(a.end, b.end)};
  const double overlap = candidate.both.length();
  if (overlap < kMinOverlap) return std::nullopt;
  if (std::abs(core::cross(front.direction, back.direction)) * overlap > limits.wedge)
    return std::nullopt;
  // Heights of both faces in the middle of what they share.
  const Vec2 middle =
      front.from + (candidate.both.begin + candidate.both.end) / 2 * candidate.direction;
  const double top = -front.height_of(middle) * front.normal().dot(normal);
  const double bottom = -back.height_of(middle) * back.normal().dot(normal);
  candidate.thickness = top - bottom;
  if (candidate.thickness < -limits.tolerance || candidate.thickness > limits.block) {
    return std::nullopt;
  }
  candidate.thickness = std::max(candidate.thickness, 0.0);
  candidate.origin = front.from + (top + bottom) / 2 * normal;
  return candidate;
}

class SolidFinder {
 public:
  SolidFinder(const OccupancyGrid& grid, std::span<const GridFace> faces, const SolidLimits& limits)
      : grid_(grid), faces_(faces), limits_(limits), covered_(faces.size()) {}

  std::vector<core::Wall> find() {
    std::vector<Candidate> candidates = match_faces();
    std::stable_sort(
        candidates.begin(), candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.thickness < b.thickness; });
    for (const Candidate& candidate : candidates) {
      if (is_covered(candidate.front, candidate) && is_covered(candidate.back, candidate)) continue;
      add(candidate);
    }
    return std::move(walls_);
  }

 private:
  std::vector<Candidate> match_faces() const {
    std::vector<core::Extent> extents;
    for (const GridFace& face : faces_) {
      extents.push_back(core::Extent::of_segment(face.from, face.to, 0));
    }
    const core::CellGrid places(extents);
    std::vector<Candidate> candidates;
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const GridFace& face = faces_[i];
      if (face.is_joint) continue;
      places.collect(core::Extent::of_segment(face.from, face.to, limits_.block), near);
      for (const std::uint32_t j : near) {
        if (j <= i || faces_[j].is_joint) continue;
        auto candidate = match(face, faces_[j], limits_);
        if (!candidate) continue;
        candidate->front = i;
        candidate->back = j;
        candidates.push_back(*candidate);
      }
    }
    return candidates;
  }

  /// No free cell across the wall at a coordinate of the axis.
  bool is_solid(const Candidate& candidate, double along, bool occupied_alone) const {
    const Vec2 centre = candidate.origin + along * candidate.direction;
    const Vec2 normal = core::rotate_left(candidate.direction);
    const double reach = std::max(candidate.thickness / 2 - kMargin, 0.0);
    for (double s = -reach; s <= reach; s += kLookStep) {
      const Cell cell = grid_.at(Vec2(centre + s * normal));
      if (cell == Cell::kFree || (occupied_alone && cell != Cell::kOccupied)) return false;
      if (reach == 0) break;
    }
    return true;
  }

  /// No free cell over the overlap of both faces, except a few samples at a rough border.
  bool is_solid(const Candidate& candidate, bool occupied_alone) const {
    std::size_t looks = 0;
    std::size_t solid = 0;
    const double end = candidate.both.end - kLookStep / 2;
    for (double s = candidate.both.begin + kLookStep / 2; s <= end; s += kLookStep) {
      ++looks;
      if (is_solid(candidate, s, occupied_alone)) ++solid;
    }
    return static_cast<double>(solid) >= 0.95 * static_cast<double>(looks);
  }

  /// Extends the overlap to the end of the longer face, as far as it is solid.
  double grow(const Candidate& candidate, bool ahead, bool occupied_alone) const {
    const double sign = ahead ? 1 : -1;
    const double from = ahead ? candidate.both.end : candidate.both.begin;
    const double to = ahead ? candidate.all.end : candidate.all.begin;
    const double last = std::abs(to - from);
    for (double s = kLookStep / 2; s < last; s += kLookStep) {
      const double along = from + sign * s;
      if (!is_solid(candidate, along, occupied_alone) &&
          !is_solid(candidate, along + sign * kLookStep, occupied_alone)) {
        return from + sign * std::max(s - kLookStep / 2, 0.0);
      }
    }
    return is_solid(candidate, to + sign, false) ? to + sign * limits_.into : to;
  }

  bool is_covered(std::size_t index, const Candidate& candidate) const {
    const GridFace& face = faces_[index];
    const Vec2 begin = candidate.origin + candidate.both.begin * candidate.direction;
    const Vec2 end = candidate.origin + candidate.both.end * candidate.direction;
    Interval part{face.along(begin), face.along(end)};
    if (part.begin > part.end) std::swap(part.begin, part.end);
    double left = 0;
    for (const Interval& open : uncovered(face.length(), covered_[index])) {
      left += std::max(0.0, std::min(open.end, part.end) - std::max(open.begin, part.begin));
    }
    return left < (1 - kEnough) * part.length();
  }

  void add(const Candidate& candidate) {
    const bool occupied_alone = candidate.thickness > limits_.thickness;
    if (!is_solid(candidate, occupied_alone)) return;
    const Interval reach{grow(candidate, false, occupied_alone),
                         grow(candidate, true, occupied_alone)};
    core::Wall wall;
    wall.thickness_m =
        candidate.thickness < limits_.min_thickness ? limits_.thin : candidate.thickness;
    const double half = wall.thickness_m / 2;
    if (reach.length() >= wall.thickness_m) {
      wall.from = candidate.origin + (reach.begin + half) * candidate.direction;
      wall.to = candidate.origin + (reach.end - half) * candidate.direction;
    } else {
      // Thicker than long: as a wall that runs across.
      const Vec2 middle = candidate.origin + (reach.begin + reach.end) / 2 * candidate.direction;
      const Vec2 across = (half - reach.length() / 2) * core::rotate_left(candidate.direction);
      wall.thickness_m = reach.length();
      wall.from = middle - across;
      wall.to = middle + across;
    }
    const core::WallBox box(wall);
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const Interval part = covered(faces_[i], box, limits_.tolerance);
      if (part.length() > 0) covered_[i].push_back(part);
    }
    walls_.push_back(wall);
  }

  const OccupancyGrid& grid_;
  std::span<const GridFace> faces_;
  const SolidLimits& limits_;
  std::vector<std::vector<Interval>> covered_;  ///< of each face
  std::vector<core::Wall> walls_;
};

/// Restricts the interval to where |start + s * slope| <= limit.
void clip(double start, double slope, double limit, Interval& stretch) {
  if (std::abs(slope) < 1e-9) {
    if (std::abs(start) > limit) stretch = {0, 0};
    return;
  }
  const double s = (-limit - start) / slope;
  const double t = (limit - start) / slope;
  stretch.begin = std::max(stretch.begin, std::min(s, t));
  stretch.end = std::min(stretch.end, std::max(s, t));
}

}  // namespace

Interval covered(const GridFace& face, const core::WallBox& wall, double tolerance) {
  const Vec2 start = wall.to_local(face.from);
  const Vec2 slope = wall.to_local(face.from + face.direction) - start;
  Interval stretch{0, face.length()};
  if (face.height_of(wall.centre) > tolerance) return {0, 0};
  clip(start.x(), slope.x(), wall.half_length_m + tolerance, stretch);
  clip(start.y(), slope.y(), wall.half_width_m + tolerance, stretch);
  return stretch;
}

std::vector<Interval> uncovered(double length, std::vector<Interval> covered) {
  std::sort(covered.begin(), covered.end(),
            [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
  std::vector<Interval> open;
  double reached = 0;
  for (const Interval& part : covered) {
    if (part.begin > reached) open.push_back({reached, std::min(part.begin, length)});
    reached = std::max(reached, part.end);
  }
  if (reached < length) open.push_back({reached, length});
  return open;
}

std::vector<core::Wall> find_solids(const OccupancyGrid& grid, std::span<const GridFace> faces,
                                    const SolidLimits& limits) {
  return SolidFinder(grid, faces, limits).find();
}

}  // namespace cornerd::gridmap
