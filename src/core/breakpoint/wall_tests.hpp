// SPDX-License-Identifier: MIT
// What is asked of neighbouring walls, and how the answers are judged.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "core/breakpoint/segment_track.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// The angles among the limits, as their tests want them: no trigonometry per wall.
struct AngleLimits {
  explicit AngleLimits(const ExtractionConfig& limits)
      : min_piece_cosine(std::cos(limits.max_piece_angle_rad)),
        min_corner_sine(std::sin(limits.min_corner_angle_rad)),
        min_rest_sine(std::sin(limits.min_rest_angle_rad)) {}
  double min_piece_cosine;
  double min_corner_sine;
  double min_rest_sine;
};

/// By what the walls of a turn are judged.
struct Judgement {
  const ExtractionConfig& limits;
  const AngleLimits& angles;
  const SensorNoise& noise;
  double noise_scale = 1;  ///< of the turn's noise to the model's

  /// Squared, in units of the model's noise.
  double gate2() const {
    return limits.gate_sigmas * limits.gate_sigmas * noise_scale * noise_scale;
  }
};

/// Samples after the end of `right` and before the beginning of `left`.
std::size_t samples_between(const PolarScan& scan, const SegmentTrack& right,
                            const SegmentTrack& left);

/// From variances in units of the range's noise to those of the noise across a line, where rays
/// meet its middle.
double across_factor(const SensorNoise& noise, const Line& line);

/// Squared distance of a sample to a line in units of the noise.
double misfit(const SensorNoise& noise, const Line& line, const PolarPoint& point);

/// True for a wall so short that it may be noise about its neighbours.
bool is_doubtful(const SegmentTrack& wall, const ExtractionConfig& limits, double noise_scale);

/// True where two neighbours are pieces of one wall.
bool is_one_wall(const PolarScan& scan, const Judgement& by, const SegmentTrack& right,
                 const SegmentTrack& left);

/// `left` becomes a part of `right`.
void append(SegmentTrack& right, const SegmentTrack& left);

inline constexpr std::size_t kNoSplit = std::numeric_limits<std::size_t>::max();

/// Where the samples of a short wall between two others all lie on these: how many of its samples,
/// from its first on, are the right one's. kNoSplit where they do not.
std::size_t split_between(const PolarScan& scan, const Judgement& by, const SegmentTrack& right,
                          const SegmentTrack& wall, const SegmentTrack& left);

}  // namespace cornerd::core
