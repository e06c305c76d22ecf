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

/// Largest distance between neighbouring samples of one segment.
enum class AbdThreshold : std::uint8_t {
  kBorgesAldon,  ///< eq. 4: by the earlier sample's range; sigma_r in metres
  kWeerakoon,    ///< eq. 5: by the shorter range and the longer one's noise; sigma_r as a share
};

struct AbdIepfConfig {
  AbdThreshold threshold = AbdThreshold::kWeerakoon;  ///< that of the paper's measurements
  double sigma_r = 0.0038;                            ///< section V.C
  double lambda_rad = core::radians(8);               ///< section V.C
  /// d_thd of IEPF, distance of a sample from the chord: three standard deviations of an A1's range
  /// at 2 m. The paper prints 0.46 m, the width of the arena's doors, which a right angle reaches
  /// only where both walls are visible for 0.65 m.
  double split_limit_m = 0.03;
};

/// D_max in metres between two neighbouring samples, `after` at the higher bearing. 0 where their
/// bearings differ by lambda or more: the virtual line of eq. 2 does not meet the later ray.
double abd_threshold_m(const AbdIepfConfig& config, const core::PolarPoint& before,
                       const core::PolarPoint& after);

/// Splits the scan where neighbours are too far apart (eq. 1), then each segment at the sample
/// farthest from the chord between its ends, until none is farther than the limit. Each piece gets
/// a regression line, weighted by the sensor's noise, from which the covariances of the breakpoints
/// follow. The sample at a split belongs to the earlier piece. The worst case, a spiral, takes n^2
/// / 2 steps.
class AbdIepf final : public core::WallFinder {
 public:
  AbdIepf(const core::DetectorConfig& detector, const core::SensorNoise& noise,
          const AbdIepfConfig& config = {});

  /// Finds walls of at least min_support samples. Returns the number of walls dropped because
  /// `tracks` is full. Allocates nothing.
  std::size_t track(const core::PolarScan& scan, core::SegmentTracks& tracks) override;

 private:
  std::size_t split(const core::PolarScan& scan, std::size_t first, std::size_t last,
                    core::SegmentTracks& tracks);
  core::SegmentTrack fit(const core::PolarScan& scan, std::size_t first, std::size_t last) const;

  core::SensorNoise noise_;
  AbdIepfConfig config_;
  std::uint32_t min_support_;
  std::vector<std::size_t> ends_;  ///< stack of the ends of unprocessed pieces
};

}  // namespace cornerd::baseline
