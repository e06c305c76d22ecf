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

/// Tracks the walls of a turn, sample by sample: a line through the samples so far predicts where
/// the next ray will meet the wall, and an ellipse around that point decides whether it did.
///
/// Three things differ from the paper's print (printed_altbd.hpp), because at an A1's density
/// (neighbours are 3-8 mm apart, noise is 2-10 mm) the printed form breaks at noise:
///  - the line is fitted to the whole segment (running sums, step 1 with every sample), not to
///    three points;
///  - the ellipse's axes follow the sensor's noise, the angle of incidence and the line's own
///    uncertainty; both terms of step 12 are squared, so that it is an ellipse. sigma_offset
///    remains as the bound of the minor axis, as a share of the range;
///  - a wall ends after three misses in a row, at the first of them: a single one is an outlier.
///
/// It takes the samples as they come: next() goes on where it stopped for want of more.
class Altbd {
 public:
  Altbd(const DetectorConfig& config, const SensorNoise& noise);

  /// Forgets the turn before, but for its noise.
  void begin();

  enum class Event : std::uint8_t {
    kNone,       ///< the scan is at its end; where it has not `ended`, it may go on
    kShortWall,  ///< a wall, begun and ended, of at most doubtful_samples
    kWallBegun,  ///< a wall has more than doubtful_samples now, and goes on
    kWallEnded,  ///< the wall that was begun
  };

  /// Forgets what the turns showed of the noise: the model is believed again.
  void forget();

  /// Tracks on through the scan, which may have grown since the last call, to the next event;
  /// `wall` is what it happened to. Walls have at least min_support samples.
  Event next(const PolarScan& scan, bool ended, SegmentTrack& wall);

  /// How much larger the residuals were than the noise model says, of late.
  double noise_scale() const;

 private:
  bool start_any(const PolarScan& scan, std::size_t index);
  bool start(const PolarScan& scan, std::size_t index, std::uint32_t samples);
  bool is_hit(const PolarScan& scan, std::size_t index);
  bool announces(SegmentTrack& wall);
  std::size_t to_follow() const;
  std::size_t follow(const PolarScan& scan);
  void refit();
  void learn_noise();
  void give_back_lone_hit(const PolarScan& scan);
  void extend(const PolarScan& scan, std::size_t index);
  double noise_variance_scale() const;

  AltbdConfig config_;
  ExtractionConfig extraction_;
  double sigma_offset_;
  std::uint32_t min_support_;
  SensorNoise noise_;

  SegmentTrack current_;
  bool tracking_ = false;
  bool begun_ = false;     ///< kWallBegun was said of the current wall
  std::size_t index_ = 0;  ///< of the wall's first sample, or of the next one to try
  std::size_t next_ = 0;
  std::uint32_t misses_ = 0;
  std::uint32_t hits_ = 0;           ///< in a row, up to the wall's last sample
  std::uint32_t before_misses_ = 0;  ///< its last sample before the misses before those hits
  std::uint32_t refit_at_ = 0;       ///< support at which the line is fitted anew
  double gate2_ = 0;                 ///< squared, in units of the noise that is believed
  double residual_sum_;              ///< of squared, normalised residuals
  double residual_count_;
};

}  // namespace cornerd::core
