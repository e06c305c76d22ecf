// SPDX-License-Identifier: MIT
// ABD and IEPF: adaptive breakpoint detector and iterative end point fit, the baseline of El Amin
// et al., sections II.B and V.C, in its textbook form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/breakpoint/wall_finder.hpp"
#include "core/detector_config.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::baseline {

/// How far apart neighbouring samples of one segment may be.
enum class AbdThreshold : std::uint8_t {
  kBorgesAldon,  ///< eq. 4: by the earlier sample's range; sigma_r in metres
  kWeerakoon,    ///< eq. 5: by the shorter range and the longer one's noise; sigma_r as a share
};

struct AbdIepfConfig {
  AbdThreshold threshold = AbdThreshold::kWeerakoon;  ///< that of the paper's measurements
  double sigma_r = 0.0038;                            ///< section V.C
  double lambda_rad = core::radians(8);               ///< section V.C
  /// d_thd of IEPF, of a sample from the chord. Three standard deviations of an A1's range at 2 m.
  /// The paper prints 0.46 m, the width of the arena's doors: a right angle stands out so far only
  /// where both its walls are seen for 0.65 m, too far for rooms in a 2.4 m arena.
  double split_limit_m = 0.03;
};

/// D_max between two neighbouring samples, `after` at the higher bearing. 0 where their bearings
/// are lambda or more apart: the virtual line of eq. 2 never meets the later ray, so
/// that they are neighbours on no wall.
double abd_threshold_m(const AbdIepfConfig& config, const core::PolarPoint& before,
                       const core::PolarPoint& after);

/// Cuts the turn where neighbours are too far apart (eq. 1), then each segment at the sample
/// farthest from the chord between its ends, until none is farther than the limit. Each piece gets
/// its regression line.
///
/// The sample that is cut at ends one chord and begins the next; the regression takes it once, for
/// the earlier piece. The weights follow the sensor's noise, since the covariances of the
/// breakpoints are made of them. In the worst case, a spiral, IEPF takes n^2 / 2 steps.
class AbdIepf final : public core::WallFinder {
 public:
  AbdIepf(const core::DetectorConfig& detector, const core::SensorNoise& noise,
          const AbdIepfConfig& config = {});

  /// Walls of at least min_support samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const core::PolarScan& scan, core::SegmentTracks& tracks) override;

 private:
  std::size_t split(const core::PolarScan& scan, std::size_t first, std::size_t last,
                    core::SegmentTracks& tracks);
  core::SegmentTrack fit(const core::PolarScan& scan, std::size_t first, std::size_t last) const;

  core::SensorNoise noise_;
  AbdIepfConfig config_;
  std::uint32_t min_support_;
  std::vector<std::size_t> ends_;  ///< of the pieces still to be looked at, the next one on top
};

}  // namespace cornerd::baseline
