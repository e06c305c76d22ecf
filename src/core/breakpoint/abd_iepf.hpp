// SPDX-License-Identifier: MIT
// ABD and IEPF: adaptive breakpoint detector and iterative end point fit, the baseline of El Amin
// et al., sections II.B and V.C, in its textbook form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/breakpoint/segment_track.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// How far apart neighbouring samples of one segment may be.
enum class AbdThreshold : std::uint8_t {
  kBorgesAldon,  ///< eq. 4: by the earlier sample's range; sigma_r in metres
  kWeerakoon,    ///< eq. 5: by the shorter range and the longer one's noise; sigma_r as a share
};

/// D_max between two neighbouring samples, `after` at the higher bearing. 0 where their bearings
/// are lambda (8 degrees) or more apart: the virtual line of eq. 2 never meets the later ray, so
/// that they are neighbours on no wall.
double abd_threshold_m(AbdThreshold threshold, const PolarPoint& before, const PolarPoint& after);

struct AbdIepfOptions {
  /// Three standard deviations of an A1's range at 2 m.
  static constexpr double kUsualSplitLimit_m = 0.03;
  /// What section V.C prints, the width of the arena's doors. A right angle stands out
  /// so far only where both its walls are seen for 0.65 m: too far for rooms in a 2.4 m arena.
  static constexpr double kPrintedSplitLimit_m = 0.46;

  AbdThreshold threshold = AbdThreshold::kWeerakoon;  ///< that of the paper's measurements
  double split_limit_m = kUsualSplitLimit_m;          ///< d_thd, of a sample from the chord
};

/// Cuts the turn where neighbours are too far apart (eq. 1), then each segment at the sample
/// farthest from the chord between its ends, until none is farther than the limit. Each piece gets
/// its regression line.
///
/// The sample that is cut at ends one chord and begins the next; the regression takes it once, for
/// the earlier piece. The weights follow the sensor's noise, since the covariances of the
/// breakpoints are made of them. In the worst case, a spiral, IEPF takes n^2 / 2 steps.
class AbdIepf {
 public:
  explicit AbdIepf(const SensorNoise& noise, const AbdIepfOptions& options = {});

  /// Walls of at least kMinSupport samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const PolarScan& scan, SegmentTracks& tracks);

  /// Constant limits learn nothing of the noise: the model is believed.
  double noise_scale() const { return 1; }

 private:
  std::size_t split(const PolarScan& scan, std::size_t first, std::size_t last,
                    SegmentTracks& tracks);
  SegmentTrack fit(const PolarScan& scan, std::size_t first, std::size_t last) const;

  SensorNoise noise_;
  AbdIepfOptions options_;
  std::vector<std::size_t> ends_;  ///< of the pieces still to be looked at, the next one on top
};

}  // namespace cornerd::core
