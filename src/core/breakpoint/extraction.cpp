// SPDX-License-Identifier: MIT
#include "core/breakpoint/extraction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/breakpoint/wall_end.hpp"
#include "core/breakpoint/wall_tests.hpp"
#include "core/geometry/linear_solve.hpp"

namespace cornerd::core {
namespace {

/// The border between a wall (on its right seen from the sensor, at lower bearings) and the next
/// one (on its left).
class Border {
 public:
  Border(const PolarScan& scan, const SegmentTrack& right, const SegmentTrack& left,
         double corner_tolerance_m, const ExtractionContext& context)
      : scan_(scan),
        right_(right),
        left_(left),
        between_(samples_between(scan, right, left)),
        corner_tolerance_m_(corner_tolerance_m),
        context_(context) {}

  std::optional<Breakpoint> corner() const;

 private:
  bool free_between(const Vec2& corner) const;
  bool is_reached(const Vec2& corner, const SegmentTrack& wall, std::size_t end, int step) const;

  const PolarScan& scan_;
  const SegmentTrack& right_;
  const SegmentTrack& left_;
  std::size_t between_;        ///< samples on neither wall
  double corner_tolerance_m_;  ///< Dth_corner
  const ExtractionContext& context_;
};

/// Covariance of the intersection from each line's variance across itself at that point.
Eigen::Matrix2d intersection_covariance(const Line& a, const Line& b, const Vec2& point,
                                        double scale) {
  Eigen::Matrix2d normals;
  normals << a.normal.transpose(), b.normal.transpose();
  const Eigen::Matrix2d inverse = core::inverse(normals);
  const double variance_a = a.variance_at(a.direction().dot(point - a.centroid));
  const double variance_b = b.variance_at(b.direction().dot(point - b.centroid));
  return scale * scale * inverse * Vec2(variance_a, variance_b).asDiagonal() * inverse.transpose();
}

/// True where the samples between the walls are no farther than the corner: no free space behind it
/// was seen.
bool Border::free_between(const Vec2& corner) const {
  const double limit_m = corner.norm() + corner_tolerance_m_;
  std::size_t behind = 0;
  for (std::size_t k = 1; k <= between_; ++k) {
    const PolarPoint& point = scan_[(right_.last + k) % scan_.size()];
    behind += point.range_m > limit_m ? 1 : 0;
  }
  if (behind != 1) return behind == 0;
  // A single sample behind is an outlier, among several samples or in a narrow gap.
  const Vec2 gap = scan_[left_.first].position() - scan_[right_.last].position();
  return between_ > context_.limits.see_through_samples ||
         gap.norm() < context_.limits.see_through_gap_m;
}

/// Extends a wall over the samples between the two walls to the last one on its line: samples
/// behind an outlier or among missing returns, which the tracker did not reach. True where the
/// corner is within Dth_corner of that sample, or, at grazing incidence, within a few rays.
bool Border::is_reached(const Vec2& corner, const SegmentTrack& wall, std::size_t end,
                        int step) const {
  const std::size_t n = scan_.size();
  const double gate2 = context_.gate2();
  std::size_t farthest = end;
  for (std::size_t k = 1; k <= between_; ++k) {
    const std::size_t index = (step > 0 ? end + k : end + n - k) % n;
    if ((scan_[index].position() - scan_[farthest].position()).norm() > context_.limits.merge_gap_m)
      break;
    if (mahalanobis_squared(context_.noise, wall.line, scan_[index]) < gate2) farthest = index;
  }
  const PolarPoint& point = scan_[farthest];
  const double distance_m = (corner - point.position()).norm();
  if (distance_m <= corner_tolerance_m_) return true;
  const double gap_rad = angle_between(point.bearing_rad, angle_of(corner));
  if (std::abs(gap_rad) > context_.limits.grazing_rays * scan_.spacing_rad()) return false;
  // The next sample must lie in front of the wall; otherwise the wall ended before the corner.
  const PolarPoint& next = scan_[step > 0 ? left_.first : right_.last];
  const double height_m = wall.line.normal.dot(next.position()) - wall.line.offset_m;
  const bool behind = height_m < 0 && mahalanobis_squared(context_.noise, wall.line, next) > gate2;
  return !behind && distance_m <= context_.limits.grazing_gap * corner_tolerance_m_;
}

std::optional<Breakpoint> Border::corner() const {
  const Line& a = right_.line;
  const Line& b = left_.line;
  const double sine = cross(a.normal, b.normal);
  if (std::abs(sine) < context_.angles.min_corner_sine) return std::nullopt;
  const Vec2 point((a.offset_m * b.normal.y() - b.offset_m * a.normal.y()) / sine,
                   (b.offset_m * a.normal.x() - a.offset_m * b.normal.x()) / sine);

  // The intersection must lie between the walls' last samples, within one sample.
  const PolarPoint& end = scan_[right_.last];
  const PolarPoint& begin = scan_[left_.first];
  const double gap_rad = angle_between(end.bearing_rad, begin.bearing_rad);
  const double bearing_rad = angle_of(point);
  const double margin_rad = 2 * scan_.spacing_rad() + context_.limits.gate_sigmas *
                                                          context_.noise.floor_m /
                                                          std::max(point.norm(), 0.05);
  if (gap_rad < -margin_rad || gap_rad > kPi / 2) return std::nullopt;
  if (angle_between(end.bearing_rad, bearing_rad) < -margin_rad) return std::nullopt;
  if (angle_between(bearing_rad, begin.bearing_rad) < -margin_rad) return std::nullopt;
  if (!is_reached(point, right_, right_.last, +1)) return std::nullopt;
  if (!is_reached(point, left_, left_.first, -1)) return std::nullopt;
  if (!free_between(point)) return std::nullopt;

  Breakpoint breakpoint;
  breakpoint.position = point;
  breakpoint.kind = BreakpointKind::kCorner;
  breakpoint.right_wall_rad = angle_of(-a.direction());
  breakpoint.left_wall_rad = angle_of(b.direction());
  double opening = angle_between(breakpoint.left_wall_rad, breakpoint.right_wall_rad);
  if (opening < 0) opening += kTwoPi;
  breakpoint.opening_rad = opening;
  breakpoint.convex = opening > kPi;
  breakpoint.right_support = right_.support;
  breakpoint.left_support = left_.support;
  breakpoint.covariance = intersection_covariance(a, b, point, context_.noise_scale);
  return breakpoint;
}

/// A third wall beyond the end of one: the next two to four free samples where they lie on a line.
/// Too few for a wall of their own, but enough to intersect.
std::optional<SegmentTrack> rest_of_wall(const PolarScan& scan, std::size_t end, int step,
                                         std::size_t free_samples,
                                         const ExtractionContext& context) {
  const std::size_t n = scan.size();
  for (std::size_t count = std::min(free_samples, context.limits.max_interruption); count >= 2;
       --count) {
    const std::size_t first = (step > 0 ? end + 1 : end + n - count) % n;
    SegmentTrack rest = SegmentTrack::starting_at(scan, first);
    for (std::size_t k = 0; k < count; ++k) rest.add(scan, (first + k) % n, context.noise);
    rest.line = rest.fit.line();
    const double sigma_angle_rad =
        context.noise_scale / std::sqrt(rest.line.weight * rest.line.variance_along);
    if (sigma_angle_rad > context.limits.stub_sigma_rad) continue;
    bool is_on_line = true;
    for (std::size_t k = 0; k < count && is_on_line; ++k) {
      const PolarPoint& point = scan[(first + k) % n];
      is_on_line = -rest.line.normal.dot(point.ray()) > context.angles.min_stub_sine &&
                   mahalanobis_squared(context.noise, rest.line, point) < context.gate2();
    }
    if (is_on_line) return rest;
  }
  return std::nullopt;
}

}  // namespace

WallSegment describe_wall(const PolarScan& scan, const SegmentTrack& wall, double noise_scale) {
  const Line& line = wall.line;
  const auto foot = [&](std::size_t index) -> Vec2 {
    const Vec2 point = scan[index].position();
    return point - (line.normal.dot(point) - line.offset_m) * line.normal;
  };
  WallSegment segment;
  segment.normal = line.normal;
  segment.offset_m = line.offset_m;
  segment.first = foot(wall.first);
  segment.last = foot(wall.last);
  segment.sigma_offset_m = noise_scale / std::sqrt(line.weight);
  segment.sigma_angle_rad = noise_scale / std::sqrt(line.weight * line.variance_along);
  segment.first_sample = wall.first;
  segment.last_sample = wall.last;
  segment.support = wall.support;
  return segment;
}

void extract_border(const PolarScan& scan, const SegmentTrack& right, const SegmentTrack& left,
                    double corner_tolerance_m, const ExtractionContext& context,
                    Detection& detection) {
  const auto add = [&](const std::optional<Breakpoint>& breakpoint) {
    if (!breakpoint) return;
    if (detection.breakpoints.size() < kMaxBreakpointsPerScan) {
      detection.breakpoints.push_back(*breakpoint);
    } else {
      ++detection.overflowed;
    }
  };
  const auto corner_of = [&](const SegmentTrack& on_right, const SegmentTrack& on_left) {
    return Border(scan, on_right, on_left, corner_tolerance_m, context).corner();
  };
  if (const std::optional<Breakpoint> corner = corner_of(right, left)) return add(corner);
  const std::size_t between = samples_between(scan, right, left);
  for (const auto& [wall, side] : {std::pair(&right, WallSide::kRight), {&left, WallSide::kLeft}}) {
    const bool on_right = side == WallSide::kRight;
    const WallEnd end(scan, *wall, side, between, context);
    std::optional<Breakpoint> found = end.corner();
    if (!found) {
      const auto rest = rest_of_wall(scan, on_right ? right.last : left.first, on_right ? +1 : -1,
                                     between, context);
      if (rest) found = on_right ? corner_of(right, *rest) : corner_of(*rest, left);
      const double limit_m = context.limits.stub_corner_sigma_m;
      if (found && found->covariance.trace() > limit_m * limit_m) found.reset();
    }
    add(found ? found : end.terminal());
  }
}

}  // namespace cornerd::core
