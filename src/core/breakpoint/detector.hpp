// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "core/breakpoint/abd_iepf.hpp"
#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/line_tracking.hpp"
#include "core/breakpoint/printed_altbd.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_polyline.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// From a scan's returns to its walls and breakpoints. The configured method tracks the walls;
/// post-processing is common. Allocates nothing after construction.
class Detector {
 public:
  Detector(const DetectorConfig& config, const SensorNoise& noise);

  void detect(const PolarScan& scan, Detection& detection);

  /// Forgets the noise estimate.
  void forget();

 private:
  using Tracker = std::variant<Altbd, PrintedAltbd, AbdIepf, LineTracking>;
  static Tracker make_tracker(const DetectorConfig& config, const SensorNoise& noise);

  Tracker tracker_;
  SegmentTracks tracks_;
  WallPolyline polyline_;
};

/// Passes ALTBD's walls, from where it stopped to the scan's end, to the polyline.
void feed(Altbd& tracker, WallPolyline& polyline, const PolarScan& scan, bool ended,
          Detection& detection);

}  // namespace cornerd::core
