// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "core/breakpoint/abd_iepf.hpp"
#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/line_tracking.hpp"
#include "core/breakpoint/printed_altbd.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/breakpoint/wall_chain.hpp"
#include "core/detector_config.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// From a turn's returns to its walls and breakpoints. The configured method finds the walls; what
/// becomes of them is the same for all. All memory is taken at construction.
class Detector {
 public:
  Detector(const DetectorConfig& config, const SensorNoise& noise);

  void detect(const PolarScan& scan, Detection& detection);

  /// Forgets what the turns showed of the noise.
  void forget();

 private:
  using Tracker = std::variant<Altbd, PrintedAltbd, AbdIepf, LineTracking>;
  static Tracker make_tracker(const DetectorConfig& config, const SensorNoise& noise);

  Tracker tracker_;
  SegmentTracks tracks_;
  WallChain chain_;
};

/// Hands the walls that ALTBD finds, from where it stopped to the scan's end, to the chain.
void feed(Altbd& tracker, WallChain& chain, const PolarScan& scan, bool ended,
          Detection& detection);

}  // namespace cornerd::core
