// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/line_fit.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// A wall under construction: its samples and the line through them.
struct SegmentTrack {
  /// An empty wall whose first sample will be `index`.
  static SegmentTrack starting_at(const PolarScan& scan, std::size_t index) {
    SegmentTrack track;
    track.fit = LineFit({scan[index].x_m, scan[index].y_m});
    track.first = static_cast<std::uint32_t>(index);
    return track;
  }

  /// Adds the sample at `index` at the end, weighted by its range's noise. Does not refit the line.
  void add(const PolarScan& scan, std::size_t index, const SensorNoise& noise) {
    const PolarPoint& point = scan[index];
    fit.add(point.x_m, point.y_m, weight_of(point, noise));
    last = static_cast<std::uint32_t>(index);
    ++support;
  }

  /// The same at the beginning.
  void add_in_front(const PolarScan& scan, std::size_t index, const SensorNoise& noise) {
    const PolarPoint& point = scan[index];
    fit.add(point.x_m, point.y_m, weight_of(point, noise));
    first = static_cast<std::uint32_t>(index);
    ++support;
  }

  /// Removes a sample. The ends stay as they were.
  void remove(const PolarScan& scan, std::size_t index, const SensorNoise& noise) {
    const PolarPoint& point = scan[index];
    fit.remove(point.x_m, point.y_m, weight_of(point, noise));
    --support;
  }

  static double weight_of(const PolarPoint& point, const SensorNoise& noise) {
    const double sigma_m = noise.sigma_range_m(point.range_m);
    return 1 / (sigma_m * sigma_m);
  }

  LineFit fit;
  Line line;
  std::uint32_t first = 0;  ///< index into the PolarScan
  std::uint32_t last = 0;   ///< inclusive; smaller than `first` for a wall across the seam
  std::uint32_t support = 0;
};

/// The walls of a scan, counter-clockwise, with room for kMaxSegmentsPerScan.
using SegmentTracks = std::vector<SegmentTrack>;

/// False where `tracks` is full.
inline bool keep_wall(const SegmentTrack& track, SegmentTracks& tracks) {
  if (tracks.size() == tracks.capacity()) return false;
  tracks.push_back(track);
  return true;
}

}  // namespace cornerd::core
