// SPDX-License-Identifier: MIT
#include "survey/line_extractor.hpp"

#include <cmath>

#include "core/breakpoint/line_fit.hpp"

namespace cornerd::survey {
namespace {

/// Errors that all samples of a scan share (bearing offset, residual motion distortion) do not
/// average out. Without this floor a near wall would outweigh all others.
constexpr double kFloor_m = 0.001;
constexpr double kFloor_rad = core::radians(0.05);
/// Samples with larger residuals are mixed pixels at the wall's ends.
constexpr double kSampleSigmas = 3.5;
/// Lines with fewer samples, or a less certain direction, are not used.
constexpr std::uint32_t kMinSupport = 5;
constexpr double kMaxSigma_rad = core::radians(8);

}  // namespace

void LineExtractor::extract(const core::PolarScan& points,
                            std::vector<LineObservation>& observations) {
  detection_.clear();
  detector_.detect(points, detection_);
  for (const core::WallSegment& segment : detection_.segments) add(points, segment, observations);
}

void LineExtractor::add(const core::PolarScan& points, const core::WallSegment& segment,
                        std::vector<LineObservation>& observations) {
  const double scale2 = squared(std::max(1.0, detection_.noise_scale));
  core::LineFit fit(segment.first);
  const std::size_t n = points.size();
  for (std::size_t i = segment.first_sample;; i = (i + 1) % n) {
    const core::PolarPoint& point = points[i];
    const double sine = std::abs(segment.normal.dot(point.ray()));
    const double variance = scale2 * noise_.variance_across_m2(point.range_m, sine);
    const double across_m = segment.normal.dot(point.position()) - segment.offset_m;
    if (squared(across_m) < squared(kSampleSigmas) * variance) {
      fit.add(point.x_m, point.y_m, 1 / variance);
    }
    if (i == segment.last_sample) break;
  }
  if (fit.count() < static_cast<int>(kMinSupport)) return;
  const core::Line line = fit.line();
  if (!(line.variance_along > 0)) return;

  LineObservation observation;
  observation.normal_rad = core::angle_of(line.normal);
  observation.centroid = line.centroid;
  observation.sigma_offset_m = std::sqrt(1 / line.weight + squared(kFloor_m));
  observation.sigma_angle_rad =
      std::sqrt(1 / (line.weight * line.variance_along) + squared(kFloor_rad));
  if (observation.sigma_angle_rad > kMaxSigma_rad) return;
  const core::Vec2 direction = along(line.normal);
  observation.begin_m = direction.dot(segment.first - line.centroid);
  observation.end_m = direction.dot(segment.last - line.centroid);
  if (!(observation.end_m > observation.begin_m)) return;
  observation.support = static_cast<std::uint32_t>(fit.count());
  observations.push_back(observation);
}

}  // namespace cornerd::survey
