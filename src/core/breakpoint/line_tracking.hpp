// SPDX-License-Identifier: MIT
// LT: line tracking, the baseline of El Amin et al., section II.A (after Siadat et al.), in its
// textbook form.
#pragma once

#include <cstddef>

#include "core/breakpoint/segment_track.hpp"
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
  /// D_max. The paper prints none; this is three standard deviations of an A1's range at 2 m.
  static constexpr double kMaxDistance_m = 0.03;

  explicit LineTracking(const SensorNoise& noise) : noise_(noise) {}

  /// Walls of at least kMinSupport samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const PolarScan& scan, SegmentTracks& tracks) const;

  /// A constant limit learns nothing of the noise: the model is believed.
  double noise_scale() const { return 1; }

 private:
  SensorNoise noise_;
};

}  // namespace cornerd::core
