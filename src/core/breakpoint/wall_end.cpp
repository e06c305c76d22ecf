// SPDX-License-Identifier: MIT
#include "core/breakpoint/wall_end.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {

/// A sample beyond the end, in the wall's frame.
struct WallEnd::Beyond {
  double along_m = 0;   ///< from the last sample's foot, outwards
  double height_m = 0;  ///< from the line towards the sensor
  double sigma_along_m = 0;
  double sigma_height_m = 0;
  double range_m = 0;
};

WallEnd::WallEnd(const PolarScan& scan, const SegmentTrack& wall, WallSide side,
                 std::size_t free_samples, const ExtractionContext& context)
    : scan_(scan),
      wall_(wall),
      side_(side),
      free_samples_(free_samples),
      context_(context),
      last_(side == WallSide::kRight ? wall.last : wall.first),
      outward_(static_cast<int>(side) * wall.line.direction()) {
  const Line& line = wall.line;
  const Vec2 point = scan[last_].position();
  foot_ = point - (line.normal.dot(point) - line.offset_m) * line.normal;
  const std::size_t n = scan.size();
  const PolarPoint& next = scan[(last_ + n + static_cast<std::size_t>(side)) % n];
  const Vec2 ray = next.ray();
  const double approach = -line.normal.dot(ray);
  constexpr double kMinApproach = 0.01;
  if (approach < kMinApproach) {
    span_m_ = 2 * context.limits.max_end_span_m;
  } else {
    span_m_ = std::max(0.0, outward_.dot(-line.offset_m / approach * ray - foot_));
  }
  face_ = find_face();
}

WallEnd::Beyond WallEnd::sample_beyond(std::size_t nth) const {
  const std::size_t n = scan_.size();
  const std::size_t index = side_ == WallSide::kRight ? last_ + nth : last_ + n - nth;
  const PolarPoint& point = scan_[index % n];
  const Vec2 breakpoint_at = point.position();
  const Vec2 ray = point.ray();
  const Vec2& normal = wall_.line.normal;
  Beyond beyond;
  beyond.along_m = outward_.dot(breakpoint_at - foot_);
  beyond.height_m = normal.dot(breakpoint_at) - wall_.line.offset_m;
  const auto sigma = [&](double share) {
    return context_.noise_scale *
           std::sqrt(context_.noise.variance_across_m2(point.range_m, std::abs(share)));
  };
  beyond.sigma_along_m = sigma(outward_.dot(ray));
  beyond.sigma_height_m = sigma(normal.dot(ray));
  beyond.range_m = point.range_m;
  return beyond;
}

Breakpoint WallEnd::breakpoint_at(double along_m, double variance_along_m2) const {
  const Line& line = wall_.line;
  Breakpoint breakpoint;
  breakpoint.position = foot_ + along_m * outward_;
  const double from_centroid_m = outward_.dot(breakpoint.position - line.centroid);
  const double variance_across =
      line.variance_at(from_centroid_m) * context_.noise_scale * context_.noise_scale;
  breakpoint.covariance = variance_along_m2 * outward_ * outward_.transpose() +
                          variance_across * line.normal * line.normal.transpose();
  const bool on_right = side_ == WallSide::kRight;
  (on_right ? breakpoint.right_wall_rad : breakpoint.left_wall_rad) = angle_of(-outward_);
  (on_right ? breakpoint.right_support : breakpoint.left_support) = wall_.support;
  return breakpoint;
}

WallEnd::Face WallEnd::find_face() const {
  Face face;
  for (; face.count < free_samples_; ++face.count) {
    const Beyond beyond = sample_beyond(face.count + 1);
    // The foot belongs to a sample with an error of its own.
    const double tolerance_m = std::sqrt(2) * context_.limits.gate_sigmas * beyond.sigma_along_m;
    if (std::abs(beyond.height_m) > context_.limits.max_face_m) break;
    if (beyond.along_m < -tolerance_m || beyond.along_m > span_m_ + tolerance_m) break;
    face.along_m += beyond.along_m;
    face.height_m += beyond.height_m;
    face.variance_along_m2 += beyond.sigma_along_m * beyond.sigma_along_m;
    face.variance_height_m2 += beyond.sigma_height_m * beyond.sigma_height_m;
  }
  if (face.count == 0) return face;
  const double samples = static_cast<double>(face.count);
  const double from_centroid_m = outward_.dot(foot_ - wall_.line.centroid);
  face.along_m /= samples;
  face.height_m /= samples;
  face.variance_along_m2 /= samples * samples;
  face.variance_height_m2 =
      face.variance_height_m2 / (samples * samples) +
      context_.noise_scale * context_.noise_scale * wall_.line.variance_at(from_centroid_m);
  return face;
}

std::optional<Breakpoint> WallEnd::corner() const {
  if (face_.count < context_.limits.min_face_samples) return std::nullopt;
  const double gate2 = context_.limits.gate_sigmas * context_.limits.gate_sigmas;
  if (face_.height_m * face_.height_m < gate2 * face_.variance_height_m2) return std::nullopt;

  constexpr double kSquareness_m2 = 1e-6;  // (a millimetre)^2: the face may be out of square
  Breakpoint breakpoint = breakpoint_at(std::clamp(face_.along_m, 0.0, span_m_),
                                        face_.variance_along_m2 + kSquareness_m2);
  breakpoint.kind = BreakpointKind::kCorner;
  breakpoint.convex = face_.height_m < 0;
  breakpoint.opening_rad = breakpoint.convex ? 3 * kPi / 2 : kPi / 2;
  const double face_rad =
      angle_of(breakpoint.convex ? Vec2(-wall_.line.normal) : wall_.line.normal);
  const bool on_right = side_ == WallSide::kRight;
  (on_right ? breakpoint.left_wall_rad : breakpoint.right_wall_rad) = face_rad;
  (on_right ? breakpoint.left_support : breakpoint.right_support) =
      static_cast<std::uint32_t>(face_.count);
  return breakpoint;
}

bool WallEnd::is_occluding(std::size_t skip) const {
  std::size_t behind = 0;
  for (std::size_t k = 1 + skip; k <= context_.limits.occlusion_samples + skip; ++k) {
    const Beyond beyond = sample_beyond(k);
    if (beyond.height_m < -context_.limits.gate_sigmas * beyond.sigma_height_m) {
      ++behind;
    } else if (beyond.range_m < scan_[last_].range_m) {
      return false;
    }
  }
  return behind >= 2;
}

std::optional<Breakpoint> WallEnd::terminal() const {
  constexpr double kFlatness_m2 = 1e-6;  // (a millimetre)^2
  if (!is_occluding(face_.count)) return std::nullopt;
  Breakpoint breakpoint;
  if (face_.count > 0) {
    // Too few samples for a corner, but enough to locate the wall's end.
    breakpoint = breakpoint_at(std::clamp(face_.along_m, 0.0, span_m_),
                               face_.variance_along_m2 + kFlatness_m2);
  } else {
    if (span_m_ > context_.limits.max_end_span_m) return std::nullopt;
    // A wall that approaches the sensor would show its end face. Without returns from there it ends
    // at its last sample.
    const bool approaches = outward_.dot(foot_) < 0;
    breakpoint = breakpoint_at(approaches ? 0 : span_m_ / 2, span_m_ * span_m_ / 12 + kFlatness_m2);
  }
  breakpoint.kind = BreakpointKind::kTerminal;
  breakpoint.convex = true;
  breakpoint.wall_on_right = side_ == WallSide::kRight;
  breakpoint.wall_on_left = side_ == WallSide::kLeft;
  return breakpoint;
}

}  // namespace cornerd::core
