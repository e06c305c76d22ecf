// SPDX-License-Identifier: MIT
#pragma once

#include "core/breakpoint/altbd.hpp"
#include "core/breakpoint/breakpoint.hpp"
#include "core/breakpoint/segment_track.hpp"
#include "core/localizer_config.hpp"
#include "core/polar_scan.hpp"

namespace cornerd::core {

/// From a turn's returns to its walls and breakpoints, by the configured method. All memory is
/// taken at construction.
class Detector {
 public:
  Detector(const DetectorConfig& config, const SensorNoise& noise);

  void detect(const PolarScan& scan, Detection& detection);

 private:
  DetectorConfig config_;
  SensorNoise noise_;
  Altbd altbd_;
  SegmentTracks tracks_;
};

}  // namespace cornerd::core
