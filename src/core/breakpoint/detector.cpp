// SPDX-License-Identifier: MIT
#include "core/breakpoint/detector.hpp"

#include "core/breakpoint/extraction.hpp"
#include "core/breakpoint/wall_joining.hpp"

namespace cornerd::core {

Detector::Detector(const DetectorConfig& config, const SensorNoise& noise)
    : config_(config), noise_(noise), altbd_(config, noise) {
  tracks_.reserve(kMaxSegmentsPerTurn);
}

void Detector::detect(const PolarScan& scan, Detection& detection) {
  detection.clear();
  detection.overflowed = altbd_.track(scan, tracks_);
  detection.noise_scale = altbd_.noise_scale();
  join_walls(scan, detection.noise_scale, tracks_);
  settle_borders(scan, noise_, tracks_);
  extract_breakpoints(scan, tracks_, config_, noise_, detection);
}

}  // namespace cornerd::core
