// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_finder.hpp"
#include "core/breakpoint/wall_polyline.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// From a scan's returns to its walls and breakpoints. ALTBD, or the configured finder, tracks the
/// walls; post-processing is common. Allocates nothing after construction.
class Detector {
 public:
  Detector(const DetectorConfig& config, const SensorNoise& noise);

  void detect(const PolarScan& scan, Detection& detection);

  /// Forgets the noise estimate.
  void forget();

 private:
  Altbd altbd_;
  std::unique_ptr<WallFinder> finder_;  ///< null: ALTBD
  SegmentTracks tracks_;
  WallPolyline polyline_;
};

/// Passes ALTBD's walls, from where it stopped to the scan's end, to the polyline.
void feed(Altbd& tracker, WallPolyline& polyline, const PolarScan& scan, bool ended,
          Detection& detection);

}  // namespace cornerd::core
