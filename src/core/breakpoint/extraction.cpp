// SPDX-License-Identifier: MIT
#include "core/breakpoint/extraction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

namespace cornerd::core {
namespace {

constexpr double kMinCornerAngle_rad = radians(15);

double heading(const Vec2& direction) { return std::atan2(direction.y(), direction.x()); }

/// One border between a wall (on the right of it as the sensor sees it, at lower bearings) and the
/// next one (on the left).
class Border {
 public:
  Border(const PolarScan& scan, const SegmentTrack& right, const SegmentTrack& left,
         const DetectorConfig& config, const SensorNoise& noise, double noise_scale)
      : scan_(scan),
        right_(right),
        left_(left),
        config_(config),
        noise_(noise),
        noise_scale_(noise_scale) {}

  std::optional<Breakpoint> corner() const;
  std::optional<Breakpoint> terminal_of_right() const;
  std::optional<Breakpoint> terminal_of_left() const;

 private:
  bool free_between(const Vec2& corner) const;
  bool ends_before(const SegmentTrack& wall, std::size_t last, int step) const;
  Breakpoint terminal(const SegmentTrack& wall, std::size_t last, int step) const;
  std::size_t neighbour(std::size_t index, int step) const {
    return (index + scan_.size() + static_cast<std::size_t>(step)) % scan_.size();
  }
  std::size_t samples_between() const {
    return (left_.first + scan_.size() - right_.last - 1) % scan_.size();
  }

  const PolarScan& scan_;
  const SegmentTrack& right_;
  const SegmentTrack& left_;
  const DetectorConfig& config_;
  const SensorNoise& noise_;
  double noise_scale_;
};

/// Covariance of the intersection: each line may move across itself by its own uncertainty there.
Eigen::Matrix2d intersection_covariance(const Line& a, const Line& b, const Vec2& point,
                                        double scale) {
  Eigen::Matrix2d normals;
  normals << a.normal.transpose(), b.normal.transpose();
  const Eigen::Matrix2d inverse = normals.inverse();
  const double variance_a = a.variance_at(a.direction().dot(point - a.centroid));
  const double variance_b = b.variance_at(b.direction().dot(point - b.centroid));
  return scale * scale * inverse * Vec2(variance_a, variance_b).asDiagonal() * inverse.transpose();
}

/// Nothing was seen through the place where the walls are said to meet: the samples between them
/// are no farther than the walls.
bool Border::free_between(const Vec2& corner) const {
  const std::size_t count = samples_between();
  const double limit_m = corner.norm() + config_.corner_tolerance_m;
  std::size_t behind = 0;
  for (std::size_t k = 1; k <= count; ++k) {
    const PolarPoint& point = scan_[(right_.last + k) % scan_.size()];
    behind += point.range_m > limit_m ? 1 : 0;
  }
  return behind == 0 || (count > 3 && behind == 1);
}

std::optional<Breakpoint> Border::corner() const {
  const Line& a = right_.line;
  const Line& b = left_.line;
  const double sine = cross(a.normal, b.normal);
  if (std::abs(sine) < std::sin(kMinCornerAngle_rad)) return std::nullopt;
  const Vec2 point((a.offset_m * b.normal.y() - b.offset_m * a.normal.y()) / sine,
                   (b.offset_m * a.normal.x() - a.offset_m * b.normal.x()) / sine);

  // The intersection lies where both walls end: between their last samples, give or take one.
  const PolarPoint& end = scan_[right_.last];
  const PolarPoint& begin = scan_[left_.first];
  const double gap_rad = angle_between(end.bearing_rad, begin.bearing_rad);
  const double bearing_rad = heading(point);
  const double margin_rad =
      2 * scan_.spacing_rad() + kGateSigmas * noise_.floor_m / std::max(point.norm(), 0.05);
  if (gap_rad < -margin_rad || gap_rad > kPi / 2) return std::nullopt;
  if (angle_between(end.bearing_rad, bearing_rad) < -margin_rad) return std::nullopt;
  if (angle_between(bearing_rad, begin.bearing_rad) < -margin_rad) return std::nullopt;
  const double to_end_m = (point - Vec2(end.x_m, end.y_m)).norm();
  const double to_begin_m = (point - Vec2(begin.x_m, begin.y_m)).norm();
  if (std::max(to_end_m, to_begin_m) > config_.corner_tolerance_m) return std::nullopt;
  if (!free_between(point)) return std::nullopt;

  Breakpoint breakpoint;
  breakpoint.position = point;
  breakpoint.kind = BreakpointKind::kCorner;
  breakpoint.right_wall_rad = heading(-a.direction());
  breakpoint.left_wall_rad = heading(b.direction());
  double opening = angle_between(breakpoint.left_wall_rad, breakpoint.right_wall_rad);
  if (opening < 0) opening += kTwoPi;
  breakpoint.opening_rad = opening;
  breakpoint.convex = opening > kPi;
  breakpoint.right_support = right_.support;
  breakpoint.left_support = left_.support;
  breakpoint.covariance = intersection_covariance(a, b, point, noise_scale_);
  return breakpoint;
}

/// True where the samples after the wall's last one lie behind the line of the wall.
bool Border::ends_before(const SegmentTrack& wall, std::size_t last, int step) const {
  constexpr int kLookAhead = 3;
  int behind = 0;
  int before = 0;
  std::size_t index = last;
  for (int k = 0; k < kLookAhead; ++k) {
    index = neighbour(index, step);
    const PolarPoint& point = scan_[index];
    const double approach = -wall.line.normal.dot(Vec2(point.ray_x, point.ray_y));
    const double height_m = wall.line.normal.dot(Vec2(point.x_m, point.y_m)) - wall.line.offset_m;
    const double sigma_m =
        std::sqrt(noise_.variance_across_m2(point.range_m, std::abs(approach))) * noise_scale_;
    const bool far_behind = height_m < -kGateSigmas * sigma_m;
    const bool nearer = point.range_m < scan_[last].range_m && !far_behind;
    behind += far_behind ? 1 : 0;
    before += nearer ? 1 : 0;
  }
  return behind >= 2 && before == 0;
}

Breakpoint Border::terminal(const SegmentTrack& wall, std::size_t last, int step) const {
  // The wall ends somewhere between its last sample and where the next ray would have met it.
  const Vec2 direction = wall.line.direction();
  const PolarPoint& end = scan_[last];
  const PolarPoint& next = scan_[neighbour(last, step)];
  const Vec2 last_point(end.x_m, end.y_m);
  const Vec2 foot =
      last_point - (wall.line.normal.dot(last_point) - wall.line.offset_m) * wall.line.normal;
  const Vec2 ray(next.ray_x, next.ray_y);
  const double approach = -wall.line.normal.dot(ray);
  double span_m = 0;
  if (approach > 0.01) {
    const Vec2 meeting = (-wall.line.offset_m / approach) * ray;
    span_m = std::max(0.0, step * direction.dot(meeting - foot));
  }
  span_m = std::min(span_m, 2 * 0.05);

  Breakpoint breakpoint;
  breakpoint.kind = BreakpointKind::kTerminal;
  breakpoint.convex = true;
  breakpoint.position = foot + step * span_m / 2 * direction;
  const double variance_along = span_m * span_m / 12 + 1e-6;
  const double variance_across =
      wall.line.variance_at(direction.dot(breakpoint.position - wall.line.centroid)) *
      noise_scale_ * noise_scale_;
  breakpoint.covariance = variance_along * direction * direction.transpose() +
                          variance_across * wall.line.normal * wall.line.normal.transpose();
  const bool wall_on_right = step > 0;
  breakpoint.wall_on_right = wall_on_right;
  breakpoint.wall_on_left = !wall_on_right;
  if (wall_on_right) {
    breakpoint.right_wall_rad = heading(-direction);
    breakpoint.right_support = wall.support;
  } else {
    breakpoint.left_wall_rad = heading(direction);
    breakpoint.left_support = wall.support;
  }
  return breakpoint;
}

std::optional<Breakpoint> Border::terminal_of_right() const {
  if (!ends_before(right_, right_.last, +1)) return std::nullopt;
  return terminal(right_, right_.last, +1);
}

std::optional<Breakpoint> Border::terminal_of_left() const {
  if (!ends_before(left_, left_.first, -1)) return std::nullopt;
  return terminal(left_, left_.first, -1);
}

WallSegment describe(const PolarScan& scan, const SegmentTrack& track, double noise_scale) {
  const Line& line = track.line;
  const auto foot = [&](std::size_t index) -> Vec2 {
    const Vec2 point(scan[index].x_m, scan[index].y_m);
    return point - (line.normal.dot(point) - line.offset_m) * line.normal;
  };
  WallSegment segment;
  segment.normal = line.normal;
  segment.offset_m = line.offset_m;
  segment.first = foot(track.first);
  segment.last = foot(track.last);
  segment.sigma_offset_m = noise_scale / std::sqrt(line.weight);
  segment.sigma_angle_rad = noise_scale / std::sqrt(line.weight * line.spread_m2);
  segment.first_sample = track.first;
  segment.last_sample = track.last;
  segment.support = track.support;
  return segment;
}

}  // namespace

void extract_breakpoints(const PolarScan& scan, const SegmentTracks& tracks,
                         const DetectorConfig& config, const SensorNoise& noise,
                         Detection& detection) {
  const auto add = [&](const std::optional<Breakpoint>& breakpoint) {
    if (!breakpoint) return;
    if (detection.breakpoints.size() < kMaxBreakpointsPerTurn) {
      detection.breakpoints.push_back(*breakpoint);
    } else {
      ++detection.overflowed;
    }
  };
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    detection.segments.push_back(describe(scan, tracks[i], detection.noise_scale));
    if (tracks.size() < 2) break;
    const SegmentTrack& left = tracks[(i + 1) % tracks.size()];
    const Border border(scan, tracks[i], left, config, noise, detection.noise_scale);
    const std::optional<Breakpoint> corner = border.corner();
    if (corner) {
      add(corner);
    } else {
      add(border.terminal_of_right());
      add(border.terminal_of_left());
    }
  }
}

}  // namespace cornerd::core
