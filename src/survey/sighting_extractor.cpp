// SPDX-License-Identifier: MIT
#include "survey/sighting_extractor.hpp"

#include <cmath>

#include "core/breakpoint/line_fit.hpp"

namespace cornerd::survey {
namespace {

/// What stays of every turn's error however many samples a wall has: the bearings' common error,
/// the rest of the motion. Without it a wall near by would outweigh all others.
constexpr double kFloor_m = 0.001;
constexpr double kFloor_rad = core::radians(0.05);
/// Residuals beyond this many sigmas do not belong to the wall: mixed pixels at its ends.
constexpr double kSampleSigmas = 3.5;
/// A wall seen in fewer samples, or whose direction is less certain, says little and costs time.
constexpr std::uint32_t kMinSupport = 5;
constexpr double kMaxSigma_rad = core::radians(8);

}  // namespace

void SightingExtractor::extract(const core::PolarScan& points, std::vector<Sighting>& sightings) {
  detection_.clear();
  detector_.detect(points, detection_);
  for (const core::WallSegment& segment : detection_.segments) add(points, segment, sightings);
}

void SightingExtractor::add(const core::PolarScan& points, const core::WallSegment& segment,
                            std::vector<Sighting>& sightings) {
  const double scale2 = squared(std::max(1.0, detection_.noise_scale));
  core::LineFit fit(segment.first);
  const std::size_t n = points.size();
  for (std::size_t i = segment.first_sample;; i = (i + 1) % n) {
    const core::PolarPoint& point = points[i];
    const double sine = std::abs(segment.normal.dot(point.ray()));
    const double variance = scale2 * noise_.variance_across_m2(point.range_m, sine);
    const double across_m = segment.normal.dot(point.place()) - segment.offset_m;
    if (squared(across_m) < squared(kSampleSigmas) * variance) {
      fit.add(point.x_m, point.y_m, 1 / variance);
    }
    if (i == segment.last_sample) break;
  }
  if (fit.count() < static_cast<int>(kMinSupport)) return;
  const core::Line line = fit.line();
  if (!(line.spread_m2 > 0)) return;

  Sighting sighting;
  sighting.normal_rad = core::angle_of(line.normal);
  sighting.centroid = line.centroid;
  sighting.sigma_offset_m = std::sqrt(1 / line.weight + squared(kFloor_m));
  sighting.sigma_angle_rad = std::sqrt(1 / (line.weight * line.spread_m2) + squared(kFloor_rad));
  if (sighting.sigma_angle_rad > kMaxSigma_rad) return;
  const core::Vec2 direction = along(line.normal);
  sighting.begin_m = direction.dot(segment.first - line.centroid);
  sighting.end_m = direction.dot(segment.last - line.centroid);
  if (!(sighting.end_m > sighting.begin_m)) return;
  sighting.support = static_cast<std::uint32_t>(fit.count());
  sightings.push_back(sighting);
}

}  // namespace cornerd::survey
