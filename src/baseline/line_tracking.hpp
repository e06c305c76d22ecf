// SPDX-License-Identifier: MIT
// LT: line tracking, the baseline of El Amin et al., section II.A (after Siadat et al.), in its
// textbook form.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/breakpoint/wall_finder.hpp"
#include "core/detector_config.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::baseline {

struct LineTrackingConfig {
  /// D_max. The paper prints none: three standard deviations of an A1's range at 2 m.
  double max_distance_m = 0.03;
};

/// A line through two samples, fitted anew with each next one (running sums), until one lies
/// farther from it than a constant. That sample starts the next line.
///
/// Nothing here is made better than the print: a line follows the samples around a corner until
/// they are D_max off, goes on over any gap, and ends at a lone outlier. Only the samples' weights
/// follow the sensor's noise, since the covariances of the breakpoints are made of them.
class LineTracking final : public core::WallFinder {
 public:
  LineTracking(const core::DetectorConfig& detector, const core::SensorNoise& noise,
               const LineTrackingConfig& config = {})
      : noise_(noise), max_distance_m_(config.max_distance_m), min_support_(detector.min_support) {}

  /// Walls of at least min_support samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const core::PolarScan& scan, core::SegmentTracks& tracks) override;

 private:
  core::SensorNoise noise_;
  double max_distance_m_;
  std::uint32_t min_support_;
};

}  // namespace cornerd::baseline
