// SPDX-License-Identifier: MIT
// LT: line tracking, the baseline of El Amin et al., section II.A (after Siadat et al.), in its
// textbook form.
#pragma once

#include <cstddef>

#include "core/breakpoint/segment_track.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// A line through two samples, fitted anew with each next one (running sums), until one lies
/// farther from it than a constant. That sample starts the next line.
///
/// Nothing here is made better than the print: a line follows the samples around a corner until
/// they are D_max off, goes on over any gap, and ends at a lone outlier. Only the samples' weights
/// follow the sensor's noise, since the covariances of the breakpoints are made of them.
class LineTracking {
 public:
  LineTracking(const DetectorConfig& config, const SensorNoise& noise)
      : noise_(noise),
        max_distance_m_(config.lt.max_distance_m),
        min_support_(config.min_support) {}

  /// Walls of at least min_support samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const PolarScan& scan, SegmentTracks& tracks) const;

 private:
  SensorNoise noise_;
  double max_distance_m_;
  std::uint32_t min_support_;
};

}  // namespace cornerd::core
