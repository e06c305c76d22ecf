// SPDX-License-Identifier: MIT
#include "core/breakpoint/detector.hpp"

#include "core/breakpoint/extraction.hpp"
#include "core/breakpoint/wall_joining.hpp"

namespace cornerd::core {

Detector::Tracker Detector::make_tracker(const DetectorConfig& config, const SensorNoise& noise) {
  switch (config.method) {
    case Method::kAbdIepf:
      return AbdIepf(noise);
    case Method::kLineTracking:
      return LineTracking(noise);
    case Method::kAltbd:
      break;
  }
  return Altbd(config, noise);
}

Detector::Detector(const DetectorConfig& config, const SensorNoise& noise)
    : config_(config), noise_(noise), tracker_(make_tracker(config, noise)) {
  tracks_.reserve(kMaxSegmentsPerTurn);
}

void Detector::detect(const PolarScan& scan, Detection& detection) {
  detection.clear();
  std::visit(
      [&](auto& tracker) {
        detection.overflowed = tracker.track(scan, tracks_);
        detection.noise_scale = tracker.noise_scale();
      },
      tracker_);
  join_walls(scan, detection.noise_scale, tracks_);
  settle_borders(scan, noise_, tracks_);
  extract_breakpoints(scan, tracks_, config_, noise_, detection);
}

}  // namespace cornerd::core
