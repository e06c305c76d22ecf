// SPDX-License-Identifier: MIT
#include "core/breakpoint/wall_joining.hpp"

#include <cmath>

namespace cornerd::core {
namespace {

/// Samples that may lie between two pieces of one wall: a table leg, a run of outliers.
constexpr std::size_t kMaxInterruption = 4;
/// What two pieces of one wall may be apart, so that no door becomes a wall.
constexpr double kMaxGap_m = 0.3;
/// Samples looked at on each side of a border.
constexpr int kBorderSamples = 4;

std::size_t samples_between(const PolarScan& scan, const SegmentTrack& a, const SegmentTrack& b) {
  return (b.first + scan.size() - a.last - 1) % scan.size();
}

double weight_of(const SensorNoise& noise, const PolarPoint& point) {
  const double sigma = noise.sigma_range_m(point.range_m);
  return 1 / (sigma * sigma);
}

bool one_wall(const PolarScan& scan, double noise_scale, const SegmentTrack& a,
              const SegmentTrack& b) {
  if (samples_between(scan, a, b) > kMaxInterruption) return false;
  const PolarPoint& end = scan[a.last];
  const PolarPoint& begin = scan[b.first];
  if (std::hypot(begin.x_m - end.x_m, begin.y_m - end.y_m) > kMaxGap_m) return false;
  if (a.line.normal.dot(b.line.normal) < std::cos(radians(20))) return false;

  // Each line, carried on to the other's middle, has to meet it within what both leave open.
  const auto meets = [&](const Line& from, const Line& to) {
    const double miss_m = from.normal.dot(to.centroid) - from.offset_m;
    const double along_m = from.direction().dot(to.centroid - from.centroid);
    const double variance = from.variance_at(along_m) + to.variance_at(0);
    const double limit = kGateSigmas * noise_scale;
    return miss_m * miss_m < limit * limit * variance;
  };
  return meets(a.line, b.line) && meets(b.line, a.line);
}

void append(SegmentTrack& a, const SegmentTrack& b) {
  a.fit.add(b.fit);
  a.line = a.fit.line();
  a.last = b.last;
  a.support += b.support;
}

/// Squared distance to the line in units of the noise.
double misfit(const SensorNoise& noise, const Line& line, const PolarPoint& point) {
  const double across_m = line.normal.dot(Vec2(point.x_m, point.y_m)) - line.offset_m;
  const double sine = std::abs(line.normal.dot(Vec2(point.ray_x, point.ray_y)));
  return across_m * across_m / noise.variance_across_m2(point.range_m, sine);
}

}  // namespace

void join_walls(const PolarScan& scan, double noise_scale, SegmentTracks& tracks) {
  if (tracks.size() < 2) return;
  std::size_t kept = 0;
  for (std::size_t i = 1; i < tracks.size(); ++i) {
    if (one_wall(scan, noise_scale, tracks[kept], tracks[i])) {
      append(tracks[kept], tracks[i]);
    } else {
      tracks[++kept] = tracks[i];
    }
  }
  tracks.resize(kept + 1);
  if (tracks.size() > 1 && one_wall(scan, noise_scale, tracks.back(), tracks.front())) {
    append(tracks.back(), tracks.front());
    tracks.erase(tracks.begin());
  }
}

void settle_borders(const PolarScan& scan, const SensorNoise& noise, SegmentTracks& tracks) {
  if (tracks.size() < 2) return;
  const std::size_t n = scan.size();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    SegmentTrack& a = tracks[i];
    SegmentTrack& b = tracks[(i + 1) % tracks.size()];
    if (samples_between(scan, a, b) > kMaxInterruption) continue;
    bool changed = false;
    const auto hand_over = [&](SegmentTrack& from, SegmentTrack& to, const PolarPoint& point) {
      const double weight = weight_of(noise, point);
      from.fit.remove(point.x_m, point.y_m, weight);
      to.fit.add(point.x_m, point.y_m, weight);
      --from.support;
      ++to.support;
      changed = true;
    };
    for (int k = 0; k < kBorderSamples && a.support > 4; ++k) {
      const PolarPoint& point = scan[a.last];
      if (misfit(noise, b.line, point) >= misfit(noise, a.line, point)) break;
      hand_over(a, b, point);
      b.first = a.last;
      a.last = static_cast<std::uint32_t>((a.last + n - 1) % n);
    }
    for (int k = 0; k < kBorderSamples && b.support > 4 && !changed; ++k) {
      const PolarPoint& point = scan[b.first];
      if (misfit(noise, a.line, point) >= misfit(noise, b.line, point)) break;
      hand_over(b, a, point);
      a.last = b.first;
      b.first = static_cast<std::uint32_t>((b.first + 1) % n);
    }
    if (changed) {
      a.line = a.fit.line();
      b.line = b.fit.line();
    }
  }
}

}  // namespace cornerd::core
