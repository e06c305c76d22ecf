// SPDX-License-Identifier: MIT
// ALTBD: adaptive line tracking breakpoint detector, after El Amin, Priandana and Hardhienata,
// "Development of Adaptive Line Tracking Breakpoint Detection Algorithm for Room Sensing using
// LiDAR Sensor" (section III.A, steps 1-19).
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/breakpoint/segment_track.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// Tracks the walls of a scan sample by sample: a line through the samples so far predicts where
/// the next ray meets the wall, and an ellipse around that point is the gate.
///
/// Three things differ from the paper's print (printed_altbd.hpp), which breaks at noise at an A1's
/// density (neighbours 3-8 mm apart, noise 2-10 mm):
///  - the line is fitted to the whole segment (running sums, step 1 with every sample), not to
///     three points;
///  - the ellipse's axes follow the sensor's noise, the angle of incidence and the line's own
///     uncertainty, and both terms of step 12 are squared. sigma_offset remains as the bound of the
///     minor axis, as a share of the range;
///  - a wall ends after three consecutive misses, at the first of them: a single miss is an
///     outlier.
///
/// Incremental: next() continues where it ran out of samples.
class Altbd {
 public:
  Altbd(const DetectorConfig& config, const SensorNoise& noise);

  /// Starts a scan; keeps the noise estimate.
  void begin();

  enum class Event : std::uint8_t {
    kNone,       ///< no more samples; continue later unless `ended`
    kShortWall,  ///< a complete wall of at most short_wall_samples
    kWallBegun,  ///< a wall has more than short_wall_samples and goes on
    kWallEnded,  ///< the wall of kWallBegun is complete
  };

  /// Forgets the noise estimate.
  void forget();

  /// Tracks through the scan, which may have grown since the last call, to the next event. `wall`:
  /// the wall of the event, with at least min_support samples.
  Event next(const PolarScan& scan, bool ended, SegmentTrack& wall);

  /// Ratio of the recent residuals' standard deviation to the noise model's.
  double noise_scale() const;

 private:
  bool start_wall(const PolarScan& scan, std::size_t index);
  bool start(const PolarScan& scan, std::size_t index, std::uint32_t samples);
  bool is_hit(const PolarScan& scan, std::size_t index);
  bool reports_begin(SegmentTrack& wall);
  std::size_t block_size() const;
  std::size_t track_block(const PolarScan& scan);
  void refit();
  void update_noise();
  void return_isolated_hit(const PolarScan& scan);
  void extend(const PolarScan& scan, std::size_t index);
  double noise_variance_scale() const;

  AltbdConfig config_;
  ExtractionConfig extraction_;
  double sigma_offset_;
  std::uint32_t min_support_;
  SensorNoise noise_;

  SegmentTrack current_;
  bool tracking_ = false;
  bool begun_ = false;     ///< kWallBegun was reported of the current wall
  std::size_t index_ = 0;  ///< of the wall's first sample, or of the next one to try
  std::size_t next_ = 0;
  std::uint32_t misses_ = 0;
  std::uint32_t hits_ = 0;  ///< consecutive, up to the wall's last sample
  std::uint32_t last_before_misses_ =
      0;  ///< the wall's last sample before the misses that precede those hits
  std::uint32_t refit_at_ = 0;  ///< support at which the line is refitted
  double gate2_ = 0;            ///< squared, in units of the estimated noise
  double residual_sum_;         ///< of squared, normalized residuals
  double residual_count_;
};

}  // namespace cornerd::core
