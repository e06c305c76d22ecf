// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "core/breakpoint/abd_iepf.hpp"
#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/line_tracking.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/localizer_config.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// From a turn's returns to its walls and breakpoints. The configured method finds the walls; what
/// becomes of them is the same for all. All memory is taken at construction.
class Detector {
 public:
  Detector(const DetectorConfig& config, const SensorNoise& noise);

  void detect(const PolarScan& scan, Detection& detection);

 private:
  using Tracker = std::variant<Altbd, AbdIepf, LineTracking>;
  static Tracker make_tracker(const DetectorConfig& config, const SensorNoise& noise);

  DetectorConfig config_;
  SensorNoise noise_;
  Tracker tracker_;
  SegmentTracks tracks_;
};

}  // namespace cornerd::core
