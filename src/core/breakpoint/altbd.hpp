// SPDX-License-Identifier: MIT
// ALTBD: adaptive line tracking breakpoint detector, after El Amin, Priandana and Hardhienata,
// "Development of Adaptive Line Tracking Breakpoint Detection Algorithm for Room Sensing using
// LiDAR Sensor" (section III.A, steps 1-19).
#pragma once

#include <cstddef>

#include "core/breakpoint/segment_track.hpp"
#include "core/localizer_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Tracks the walls of a turn, sample by sample: a line through the samples so far predicts where
/// the next ray will meet the wall, and an ellipse around that point decides whether it did.
///
/// Three things differ from the paper's print, because at an A1's density (neighbours are 3-8 mm
/// apart, noise is 2-10 mm) the printed form breaks at noise:
///  - the line is fitted to the whole segment (running sums, step 1 with every sample), not to
///  three
///    points;
///  - the ellipse's axes follow the sensor's noise, the angle of incidence and the line's own
///    uncertainty; both terms of step 12 are squared, so that it is an ellipse. sigma_offset
///    remains as the bound of the minor axis, as a share of the range;
///  - a wall ends after three misses in a row, at the first of them: a single one is an outlier.
class Altbd {
 public:
  explicit Altbd(const DetectorConfig& config, const SensorNoise& noise);

  /// Walls of at least kMinSupport samples. Allocates nothing beyond the capacity of `tracks`;
  /// walls that do not fit are dropped, and counted in the result.
  std::size_t track(const PolarScan& scan, SegmentTracks& tracks);

  /// How much larger the residuals were than the noise model says, over the last turn.
  double noise_scale() const;

 private:
  struct Prediction;
  Prediction predict(const PolarScan& scan, std::size_t index) const;
  bool start(const PolarScan& scan, std::size_t index);
  void extend(const PolarScan& scan, std::size_t index);
  void learn_noise(double z_square);

  DetectorConfig config_;
  SensorNoise noise_;
  SegmentTrack current_;
  double residual_sum_ = 0;  ///< of squared, normalised residuals
  double residual_count_ = 0;
};

}  // namespace cornerd::core
