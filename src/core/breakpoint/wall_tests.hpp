// SPDX-License-Identifier: MIT
// Tests of neighbouring walls.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "core/breakpoint/segment_track.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// The limits' angles as sines and cosines, computed once.
struct AngleLimits {
  explicit AngleLimits(const ExtractionConfig& limits)
      : min_merge_cosine(std::cos(limits.merge_angle_rad)),
        min_corner_sine(std::sin(limits.min_corner_angle_rad)),
        min_stub_sine(std::sin(limits.stub_angle_rad)) {}
  double min_merge_cosine;
  double min_corner_sine;
  double min_stub_sine;
};

/// What the tests of one scan's walls need.
struct ExtractionContext {
  const ExtractionConfig& limits;
  const AngleLimits& angles;
  const SensorNoise& noise;
  double noise_scale = 1;  ///< of the scan's noise to the model's

  /// Squared gate in units of the model's noise.
  double gate2() const {
    return limits.gate_sigmas * limits.gate_sigmas * noise_scale * noise_scale;
  }
};

/// Samples after the end of `right` and before the beginning of `left`.
std::size_t samples_between(const PolarScan& scan, const SegmentTrack& right,
                            const SegmentTrack& left);

/// Factor from variances in units of the range's noise to units of the noise across a line, at its
/// middle.
double across_factor(const SensorNoise& noise, const Line& line);

/// Squared Mahalanobis distance of a sample to a line.
double mahalanobis_squared(const SensorNoise& noise, const Line& line, const PolarPoint& point);

/// True for a wall so short that it may be noise of its neighbours.
bool is_short(const SegmentTrack& wall, const ExtractionConfig& limits, double noise_scale);

/// True where two neighbours are pieces of one wall.
bool is_one_wall(const PolarScan& scan, const ExtractionContext& context, const SegmentTrack& right,
                 const SegmentTrack& left);

/// Adds `left` to `right`.
void append(SegmentTrack& right, const SegmentTrack& left);

inline constexpr std::size_t kNoSplit = std::numeric_limits<std::size_t>::max();

/// Where all samples of a short wall lie on its neighbours' lines: the number of its first samples
/// that belong to the right one. Otherwise kNoSplit.
std::size_t split_between(const PolarScan& scan, const ExtractionContext& context,
                          const SegmentTrack& right, const SegmentTrack& wall,
                          const SegmentTrack& left);

}  // namespace cornerd::core
