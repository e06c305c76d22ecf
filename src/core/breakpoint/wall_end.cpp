// SPDX-License-Identifier: MIT
#include "core/breakpoint/wall_end.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
namespace {

/// Samples that show a face: one alone may be a mixed pixel.
constexpr std::size_t kMinFaceSamples = 2;
/// Samples beyond the end that are asked whether the wall hides them.
constexpr std::size_t kLookAhead = 3;

}  // namespace

/// A sample beyond the end, as the wall sees it.
struct WallEnd::Beyond {
  double along_m = 0;   ///< from the last sample's foot, outwards
  double height_m = 0;  ///< from the line towards the sensor
  double sigma_along_m = 0;
  double sigma_height_m = 0;
  double range_m = 0;
};

WallEnd::WallEnd(const PolarScan& scan, const SegmentTrack& wall, WallSide side,
                 std::size_t free_samples, const Judgement& by)
    : scan_(scan),
      wall_(wall),
      side_(side),
      free_samples_(free_samples),
      by_(by),
      last_(side == WallSide::kRight ? wall.last : wall.first),
      outward_(static_cast<int>(side) * wall.line.direction()) {
  const Line& line = wall.line;
  const Vec2 point = scan[last_].place();
  foot_ = point - (line.normal.dot(point) - line.offset_m) * line.normal;
  const std::size_t n = scan.size();
  const PolarPoint& next = scan[(last_ + n + static_cast<std::size_t>(side)) % n];
  const Vec2 ray = next.ray();
  const double approach = -line.normal.dot(ray);
  constexpr double kMinApproach = 0.01;
  if (approach < kMinApproach) {
    span_m_ = 2 * by.limits.max_end_span_m;
  } else {
    span_m_ = std::max(0.0, outward_.dot(-line.offset_m / approach * ray - foot_));
  }
}

WallEnd::Beyond WallEnd::look(std::size_t nth) const {
  const std::size_t n = scan_.size();
  const std::size_t index = side_ == WallSide::kRight ? last_ + nth : last_ + n - nth;
  const PolarPoint& point = scan_[index % n];
  const Vec2 place = point.place();
  const Vec2 ray = point.ray();
  const Vec2& normal = wall_.line.normal;
  Beyond beyond;
  beyond.along_m = outward_.dot(place - foot_);
  beyond.height_m = normal.dot(place) - wall_.line.offset_m;
  const auto sigma = [&](double share) {
    return by_.noise_scale *
           std::sqrt(by_.noise.variance_across_m2(point.range_m, std::abs(share)));
  };
  beyond.sigma_along_m = sigma(outward_.dot(ray));
  beyond.sigma_height_m = sigma(normal.dot(ray));
  beyond.range_m = point.range_m;
  return beyond;
}

Breakpoint WallEnd::place(double along_m, double variance_along_m2) const {
  const Line& line = wall_.line;
  Breakpoint breakpoint;
  breakpoint.position = foot_ + along_m * outward_;
  const double from_centroid_m = outward_.dot(breakpoint.position - line.centroid);
  const double variance_across =
      line.variance_at(from_centroid_m) * by_.noise_scale * by_.noise_scale;
  breakpoint.covariance = variance_along_m2 * outward_ * outward_.transpose() +
                          variance_across * line.normal * line.normal.transpose();
  const bool on_right = side_ == WallSide::kRight;
  (on_right ? breakpoint.right_wall_rad : breakpoint.left_wall_rad) = angle_of(-outward_);
  (on_right ? breakpoint.right_support : breakpoint.left_support) = wall_.support;
  return breakpoint;
}

std::optional<Breakpoint> WallEnd::corner() const {
  double along_sum = 0;
  double height_sum = 0;
  double variance_along = 0;
  double variance_height = 0;
  std::size_t count = 0;
  for (; count < free_samples_; ++count) {
    const Beyond beyond = look(count + 1);
    // The foot is that of a sample with an error of its own.
    const double slack_m = std::sqrt(2) * by_.limits.gate_sigmas * beyond.sigma_along_m;
    if (std::abs(beyond.height_m) > by_.limits.max_face_m) break;
    if (beyond.along_m < -slack_m || beyond.along_m > span_m_ + slack_m) break;
    along_sum += beyond.along_m;
    height_sum += beyond.height_m;
    variance_along += beyond.sigma_along_m * beyond.sigma_along_m;
    variance_height += beyond.sigma_height_m * beyond.sigma_height_m;
  }
  if (count < kMinFaceSamples) return std::nullopt;
  const double samples = static_cast<double>(count);
  const double from_centroid_m = outward_.dot(foot_ - wall_.line.centroid);
  const double variance_line =
      by_.noise_scale * by_.noise_scale * wall_.line.variance_at(from_centroid_m);
  const double variance = variance_height + samples * samples * variance_line;
  if (height_sum * height_sum < by_.limits.gate_sigmas * by_.limits.gate_sigmas * variance)
    return std::nullopt;

  const double along_m = std::clamp(along_sum / samples, 0.0, span_m_);
  constexpr double kSquareness_m2 = 1e-6;  // of the face: a millimetre
  Breakpoint breakpoint = place(along_m, variance_along / (samples * samples) + kSquareness_m2);
  breakpoint.kind = BreakpointKind::kCorner;
  breakpoint.convex = height_sum < 0;
  breakpoint.opening_rad = breakpoint.convex ? 3 * kPi / 2 : kPi / 2;
  const double face_rad =
      angle_of(breakpoint.convex ? Vec2(-wall_.line.normal) : wall_.line.normal);
  const bool on_right = side_ == WallSide::kRight;
  (on_right ? breakpoint.left_wall_rad : breakpoint.right_wall_rad) = face_rad;
  (on_right ? breakpoint.left_support : breakpoint.right_support) =
      static_cast<std::uint32_t>(count);
  return breakpoint;
}

bool WallEnd::goes_on_behind() const {
  std::size_t behind = 0;
  for (std::size_t k = 1; k <= kLookAhead; ++k) {
    const Beyond beyond = look(k);
    if (beyond.height_m < -by_.limits.gate_sigmas * beyond.sigma_height_m) {
      ++behind;
    } else if (beyond.range_m < scan_[last_].range_m) {
      return false;
    }
  }
  return behind >= 2;
}

std::optional<Breakpoint> WallEnd::terminal() const {
  if (span_m_ > by_.limits.max_end_span_m || !goes_on_behind()) return std::nullopt;
  constexpr double kFlatness_m2 = 1e-6;  // a millimetre
  Breakpoint breakpoint = place(span_m_ / 2, span_m_ * span_m_ / 12 + kFlatness_m2);
  breakpoint.kind = BreakpointKind::kTerminal;
  breakpoint.convex = true;
  breakpoint.wall_on_right = side_ == WallSide::kRight;
  breakpoint.wall_on_left = side_ == WallSide::kLeft;
  return breakpoint;
}

}  // namespace cornerd::core
