// SPDX-License-Identifier: MIT
// ALTBD as El Amin et al. print it (section III.A, steps 1-19), in the readings that the print
// leaves open. `cornerd-bench --variants` measures them; README.md beside this file concludes.
#pragma once

#include <cstddef>

#include "core/breakpoint/segment_track.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// One wall after another: a line through three samples predicts the next, one outside the ellipse
/// ends the wall. The next wall begins with that sample where it is within Dth_corner of the
/// prediction (step 14), else with the wall's last one (step 15). Corners are placed as all
/// methods' are, at the intersection of the walls (extraction.hpp), not at step 14's foot.
class PrintedAltbd {
 public:
  PrintedAltbd(const DetectorConfig& config, const SensorNoise& noise);

  /// Walls of at least min_support samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const PolarScan& scan, SegmentTracks& tracks);

 private:
  struct Miss;
  void start(const PolarScan& scan, std::size_t index);
  Miss measure(const PolarScan& scan, std::size_t index) const;
  bool inside(const Miss& miss) const;
  void extend(const PolarScan& scan, std::size_t index, double error);
  double mean_error() const;

  DetectorConfig config_;
  SensorNoise noise_;
  SegmentTrack current_;
  Line predictor_;
  double errors_[3] = {};
  double error_sum_ = 0;
};

}  // namespace cornerd::core
