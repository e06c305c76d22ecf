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

/// The polyline of a scan's walls, built as a tracker finds them: pieces of one wall are joined,
/// short walls that are noise of their neighbours merged into them, samples at corners reassigned,
/// and each border reported as soon as it is final. The last wall and the first are neighbours: the
/// seam is no breakpoint.
class WallPolyline {
 public:
  WallPolyline(const DetectorConfig& config, const SensorNoise& noise);

  /// Starts a scan.
  void begin();

  /// Adds the next wall, complete or as far as it is tracked.
  void add(const PolarScan& scan, const SegmentTrack& wall, double noise_scale,
           Detection& detection);

  /// Replaces the wall of the last add(), which has grown.
  void extend_last(const SegmentTrack& wall);

  /// Ends the scan: reports the remaining borders and describes all walls.
  void finish(const PolarScan& scan, double noise_scale, Detection& detection);

 private:
  ExtractionContext context(double noise_scale) const {
    return {config_.extraction, angles_, noise_, noise_scale};
  }
  bool merge_segments(const PolarScan& scan, std::size_t before, std::size_t short_wall,
                      SegmentTrack& after, double noise_scale);
  void reassign_points(const PolarScan& scan, SegmentTrack& right, SegmentTrack& left) const;
  void advance(const PolarScan& scan, std::size_t certain, double noise_scale,
               Detection& detection);
  void close_seam(const PolarScan& scan, double noise_scale);
  void report(const PolarScan& scan, std::size_t right, double noise_scale, Detection& detection);

  DetectorConfig config_;
  AngleLimits angles_;
  SensorNoise noise_;
  SegmentTracks walls_;
  SegmentTrack last_added_;  ///< as passed to add()
  std::size_t reassigned_ =
      0;  ///< borders (i, i + 1) with i below this have their samples reassigned
  std::size_t reported_ = 1;      ///< borders below this are reported
  bool has_first_border_ = true;  ///< false once the seam has changed border 0
};

}  // namespace cornerd::core
