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
  /// D_max. The paper prints no value; here three standard deviations of an A1's range at 2 m.
  double max_distance_m = 0.03;
};

/// A line through two samples is refitted with each next one (running sums), until a sample is
/// farther from it than D_max. That sample starts the next line. As printed, a line continues over
/// any gap and ends at a single outlier. Only the weights follow the sensor's noise, since the
/// covariances of the breakpoints follow from them.
class LineTracking final : public core::WallFinder {
 public:
  LineTracking(const core::DetectorConfig& detector, const core::SensorNoise& noise,
               const LineTrackingConfig& config = {})
      : noise_(noise), max_distance_m_(config.max_distance_m), min_support_(detector.min_support) {}

  /// Finds walls of at least min_support samples. Returns the number of walls dropped because
  /// `tracks` is full. Allocates nothing.
  std::size_t track(const core::PolarScan& scan, core::SegmentTracks& tracks) override;

 private:
  core::SensorNoise noise_;
  double max_distance_m_;
  std::uint32_t min_support_;
};

}  // namespace cornerd::baseline
