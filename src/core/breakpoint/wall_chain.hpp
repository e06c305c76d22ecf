// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_tests.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"
#include "core/sensor_noise.hpp"

namespace cornerd::core {

/// The walls of a turn, one after another as a tracker finds them, made into what they are: pieces
/// of one wall are joined, short ones that are mere noise about their neighbours dissolved, samples
/// at a corner given to the wall that they lie on, and every border between two walls is looked at
/// for its breakpoint as soon as nothing that follows can change it. The circle closes at the end:
/// its seam is no breakpoint.
class WallChain {
 public:
  WallChain(const DetectorConfig& config, const SensorNoise& noise);

  /// Forgets the turn before.
  void begin();

  /// The next wall, whole or as far as it is known.
  void add(const PolarScan& scan, const SegmentTrack& wall, double noise_scale,
           Detection& detection);

  /// The wall that add() was given last is now `wall`.
  void grow(const SegmentTrack& wall);

  /// The turn is at its end: what the seam held back is reported, and all walls are described.
  void finish(const PolarScan& scan, double noise_scale, Detection& detection);

 private:
  Judgement judgement(double noise_scale) const {
    return {config_.extraction, angles_, noise_, noise_scale};
  }
  bool dissolve(const PolarScan& scan, std::size_t before, std::size_t doubtful,
                SegmentTrack& after, double noise_scale);
  void settle(const PolarScan& scan, SegmentTrack& right, SegmentTrack& left) const;
  void advance(const PolarScan& scan, std::size_t certain, double noise_scale,
               Detection& detection);
  void close_seam(const PolarScan& scan, double noise_scale);
  void report(const PolarScan& scan, std::size_t right, double noise_scale, Detection& detection);

  DetectorConfig config_;
  AngleLimits angles_;
  SensorNoise noise_;
  SegmentTracks walls_;
  SegmentTrack added_;        ///< the last wall as add() was given it
  std::size_t settled_ = 0;   ///< borders (i, i + 1) with i below this have their samples
  std::size_t reported_ = 1;  ///< and those below this their breakpoint
  bool holds_first_ = true;   ///< all but border 0, whose wall may go on beyond the seam
};

}  // namespace cornerd::core
