// SPDX-License-Identifier: MIT
// ABD and IEPF: adaptive breakpoint detector and iterative end point fit, the baseline of El Amin
// et al., sections II.B and V.C, in its textbook form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/breakpoint/segment_track.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// D_max between two neighbouring samples, `after` at the higher bearing. 0 where their bearings
/// are lambda or more apart: the virtual line of eq. 2 never meets the later ray, so
/// that they are neighbours on no wall.
double abd_threshold_m(const AbdIepfConfig& config, const PolarPoint& before,
                       const PolarPoint& after);

/// Cuts the turn where neighbours are too far apart (eq. 1), then each segment at the sample
/// farthest from the chord between its ends, until none is farther than the limit. Each piece gets
/// its regression line.
///
/// The sample that is cut at ends one chord and begins the next; the regression takes it once, for
/// the earlier piece. The weights follow the sensor's noise, since the covariances of the
/// breakpoints are made of them. In the worst case, a spiral, IEPF takes n^2 / 2 steps.
class AbdIepf {
 public:
  AbdIepf(const DetectorConfig& config, const SensorNoise& noise);

  /// Walls of at least min_support samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const PolarScan& scan, SegmentTracks& tracks);

 private:
  std::size_t split(const PolarScan& scan, std::size_t first, std::size_t last,
                    SegmentTracks& tracks);
  SegmentTrack fit(const PolarScan& scan, std::size_t first, std::size_t last) const;

  SensorNoise noise_;
  AbdIepfConfig config_;
  std::uint32_t min_support_;
  std::vector<std::size_t> ends_;  ///< of the pieces still to be looked at, the next one on top
};

}  // namespace cornerd::core
