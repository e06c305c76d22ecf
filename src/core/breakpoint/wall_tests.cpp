// SPDX-License-Identifier: MIT
#include "core/breakpoint/wall_tests.hpp"

#include <algorithm>
#include <cmath>

namespace cornerd::core {
double across_factor(const SensorNoise& noise, const Line& line) {
  const double range_m = line.centroid.norm();
  const double sine = std::min(1.0, -line.offset_m / range_m);
  const double sigma_m = noise.sigma_range_m(range_m);
  return sigma_m * sigma_m / noise.variance_across_m2(range_m, sine);
}

std::size_t samples_between(const PolarScan& scan, const SegmentTrack& right,
                            const SegmentTrack& left) {
  return (left.first + scan.size() - right.last - 1) % scan.size();
}

double mahalanobis_squared(const SensorNoise& noise, const Line& line, const PolarPoint& point) {
  const double across_m = line.normal.dot(point.position()) - line.offset_m;
  const double sine = std::abs(line.normal.dot(point.ray()));
  return across_m * across_m / noise.variance_across_m2(point.range_m, sine);
}

bool is_short(const SegmentTrack& wall, const ExtractionConfig& limits, double noise_scale) {
  const double limit = limits.short_wall_sigma_rad / noise_scale;
  return wall.support <= limits.short_wall_samples ||
         wall.line.weight * wall.line.variance_along * limit * limit < 1;
}

bool is_one_wall(const PolarScan& scan, const ExtractionContext& context, const SegmentTrack& right,
                 const SegmentTrack& left) {
  if (samples_between(scan, right, left) > context.limits.max_interruption) return false;
  const Vec2 gap = scan[left.first].position() - scan[right.last].position();
  if (gap.norm() > context.limits.merge_gap_m) return false;
  if (right.line.normal.dot(left.line.normal) < context.angles.min_merge_cosine) return false;

  LineFit both = right.fit;
  both.add(left.fit);
  const double cost = both.chi_square() - right.fit.chi_square() - left.fit.chi_square();
  const double limit = context.limits.merge_chi_square * context.noise_scale * context.noise_scale;
  return cost * across_factor(context.noise, both.line()) < limit;
}

void append(SegmentTrack& right, const SegmentTrack& left) {
  right.fit.add(left.fit);
  right.line = right.fit.line();
  right.last = left.last;
  right.support += left.support;
}

std::size_t split_between(const PolarScan& scan, const ExtractionContext& context,
                          const SegmentTrack& right, const SegmentTrack& wall,
                          const SegmentTrack& left) {
  if (samples_between(scan, right, wall) > context.limits.max_interruption) return kNoSplit;
  if (samples_between(scan, wall, left) > context.limits.max_interruption) return kNoSplit;
  const std::size_t n = scan.size();
  const std::size_t count = (wall.last + n - wall.first) % n + 1;
  const double gate = context.gate2();
  // The best index to change from one line to the other; an outlier costs the gate.
  double all_left = 0;
  for (std::size_t k = 0; k < count; ++k) {
    all_left +=
        std::min(gate, mahalanobis_squared(context.noise, left.line, scan[(wall.first + k) % n]));
  }
  double cost = all_left;
  double best = all_left;
  std::size_t split = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const PolarPoint& point = scan[(wall.first + k) % n];
    cost += std::min(gate, mahalanobis_squared(context.noise, right.line, point)) -
            std::min(gate, mahalanobis_squared(context.noise, left.line, point));
    if (cost < best) {
      best = cost;
      split = k + 1;
    }
  }
  // Mean plus three and a half standard deviations of a chi-square.
  const double samples = static_cast<double>(count);
  const double limit = samples + context.limits.gate_sigmas * std::sqrt(2 * samples);
  return best < limit * context.noise_scale * context.noise_scale ? split : kNoSplit;
}

}  // namespace cornerd::core
